// Sums of films and counts.
#include "vpm/job/pieces.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "vpm/base/error.h"

namespace vpm {
namespace {

void check_alike(const RenderResult& whole, const RenderResult& piece) {
  const Film &a = whole.film, &b = piece.film;
  if (a.width() != b.width() || a.height() != b.height())
    throw InputError(fmt::format("films of {} x {} and of {} x {} pixels do not add up", a.width(), a.height(),
                                 b.width(), b.height()));
  if (whole.layers.size() != piece.layers.size())
    throw InputError(
        fmt::format("pieces of {} and of {} films of layers do not add up", whole.layers.size(), piece.layers.size()));
  if (!whole.discs.empty() || !piece.discs.empty())
    throw InputError("pieces whose pixels have radii of their own do not add up: these follow from all passes before");
}

}  // namespace

void add_piece(RenderResult& whole, const RenderResult& piece) {
  check_alike(whole, piece);
  whole.film.merge(piece.film);
  for (size_t i = 0; i < whole.layers.size(); ++i) whole.layers[i].merge(piece.layers[i]);
  whole.statistics.merge(piece.statistics);
  whole.seconds += piece.seconds;
  whole.errors.reset();
}

std::string passes_text(const PassSet& passes) {
  std::vector<std::string> texts;
  for (const PassRange& range : passes.ranges())
    texts.push_back(range.end - range.first == 1 ? std::to_string(range.first)
                                                 : fmt::format("{} to {}", range.first, range.end - 1));
  return texts.empty() ? "none" : fmt::format("{}", fmt::join(texts, ", "));
}

PassSet missing_passes(const PassSet& passes) {
  PassSet missing;
  int next = 0;
  for (const PassRange& range : passes.ranges()) {
    if (range.first > next) missing.add({next, range.first});
    next = range.end;
  }
  return missing;
}

}  // namespace vpm
