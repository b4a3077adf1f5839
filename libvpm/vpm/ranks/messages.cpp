// Named fields of images and counts; the identity as lines, and the result as a checkpoint has it.
#include "vpm/ranks/messages.h"

#include <fmt/format.h>

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "vpm/base/error.h"
#include "vpm/job/checkpoint.h"
#include "vpm/render/counted_fields.h"

namespace vpm {

template <>
inline constexpr std::string_view kFieldType<Rgb> = "rgb32";

namespace {

void append_image(std::string& bytes, const std::string& name, const Image& image) {
  append_field(bytes, name + ".width", image.width);
  append_field(bytes, name + ".height", image.height);
  append_field(bytes, name, std::span<const Rgb>(image.pixels));
}

Image take_image(NamedFields& fields, const std::string& name) {
  Image image;
  image.width = fields.take<int>(name + ".width");
  image.height = fields.take<int>(name + ".height");
  image.pixels = fields.take_all<Rgb>(name);
  return image;
}

std::string layer_name(size_t number) { return fmt::format("layers.{}", number); }

}  // namespace

std::string bytes_of(const Pass& pass) {
  std::string bytes;
  append_image(bytes, "image", pass.image);
  append_image(bytes, "correction", pass.correction);
  append_field(bytes, "layers", static_cast<uint64_t>(pass.layers.size()));
  for (size_t i = 0; i < pass.layers.size(); ++i) append_image(bytes, layer_name(i), pass.layers[i]);
  append_field(bytes, "found", std::span<const uint64_t>(pass.found));
  append_counters(bytes, pass.statistics);
  return bytes;
}

Pass pass_of(std::string_view bytes) {
  NamedFields fields(bytes);
  Pass pass(0, 0);
  pass.image = take_image(fields, "image");
  pass.correction = take_image(fields, "correction");
  pass.layers.resize(fields.take<uint64_t>("layers"));
  for (size_t i = 0; i < pass.layers.size(); ++i) pass.layers[i] = take_image(fields, layer_name(i));
  pass.found = fields.take_all<uint64_t>("found");
  take_counters(fields, pass.statistics);
  fields.refuse_others();
  return pass;
}

namespace {

constexpr std::string_view kToRender = "render";

void send_to_others(Ranks& ranks, const std::string& bytes) {
  for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(rank, bytes);
}

}  // namespace

void send_render(Ranks& ranks, const Identity& identity) { send_to_others(ranks, lines_of(kToRender, identity)); }

Identity receive_render(Ranks& ranks) {
  const Message message = wait_for_message(ranks);
  std::string_view text = message.bytes;
  const std::optional<Identity> received = take_lines(text, kToRender);
  if (!received) throw std::runtime_error("rank 0 is another program");
  return *received;
}

void adopt_render(RenderJob& job, const Identity& led) {
  if (job.automatic.any()) choose_again(job, choices_of(led));
  const Identity own = identity_of(job);
  if (own == led) return;
  throw InputError("this rank would render something else: its files, its program or its options differ" +
                   differences(led, own, "of rank 0", "here"));
}

void send_result(Ranks& ranks, const RenderResult& result) {
  if (ranks.size() > 1) send_to_others(ranks, bytes_of(result));
}

RenderResult receive_result(Ranks& ranks) {
  RenderResult result = result_of(wait_for_message(ranks).bytes);
  result.errors = errors_of(result);  // as at the end of a render
  return result;
}

}  // namespace vpm
