// The file: a line of its own kind, that of its format, those of identity, that of its origin, named fields, and the
// checksum of all.
#include "vpm/job/checkpoint.h"

#include <fmt/format.h>
#include <algorithm>
#include <fstream>
#include <sstream>

#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/base/fnv.h"
#include "vpm/base/lines.h"
#include "vpm/film/view_layers.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/render/counted_fields.h"

namespace vpm {

template <>
inline constexpr std::string_view kFieldType<PassRange> = "range";
template <>
inline constexpr std::string_view kFieldType<PixelDisc> = "disc";

namespace {

constexpr const char* kKind = "vpm checkpoint of a render";
constexpr std::string_view kIdentity = "identity", kOrigin = "origin";
constexpr size_t kChecksum = 16;  // characters at the end

std::string checksum(std::string_view bytes) {
  Fnv1a hash;
  hash.add(bytes);
  return hash.digits();
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("cannot go on from '{}': {}", path.string(), why));
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::error_code unknown;
  if (!stream && std::filesystem::exists(path, unknown)) refuse(path, "it may not be read");
  if (!stream) refuse(path, "there is no such file; render with --checkpoint to have one after each pass");
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

struct Parts {
  Identity identity;
  Origin origin;
  std::string_view rest;  // fields and checksum
};

/// Checks kind and format.
Parts parts_of(const std::filesystem::path& path, std::string_view bytes) {
  constexpr std::string_view kFormat = "format ";
  std::string_view kind, format;
  if (!take_line(bytes, kind) || kind != kKind || !take_line(bytes, format)) refuse(path, "it is no checkpoint");
  const bool numbered = format.starts_with(kFormat);
  const std::string number(numbered ? format.substr(kFormat.size()) : "1");  // the first had no such line
  if (number != std::to_string(kCheckpointFormat))
    refuse(path, fmt::format("it is written by another format of checkpoints, {}; this program reads {}; render again",
                             number, kCheckpointFormat));
  const std::optional<Identity> identity = take_lines(bytes, kIdentity), origin = take_lines(bytes, kOrigin);
  if (!identity || !origin) refuse(path, "it is damaged or not whole: it does not say what it is of");
  try {
    return {*identity, origin_from(*origin), bytes};
  } catch (const std::invalid_argument&) {
    refuse(path, "it is damaged: it does not say where its scene is read from");
  }
}

/// Of each block where its words start, how many there are of each sum, and these.
void append_sums(std::string& bytes, const std::string& name, std::span<const ExactSums> sums) {
  std::vector<uint32_t> numbers;
  for (const ExactSums& block : sums) {
    numbers.push_back(static_cast<uint32_t>(block.lowest_word()));
    numbers.push_back(static_cast<uint32_t>(block.words().size() / ExactSums::kCount));
    numbers.insert(numbers.end(), block.words().begin(), block.words().end());
  }
  append_field(bytes, name, std::span<const uint32_t>(numbers));
}

std::vector<ExactSums> take_sums(NamedFields& fields, const std::string& name, size_t blocks) {
  const std::vector<uint32_t> numbers = fields.take_all<uint32_t>(name);
  const FieldError wrong(fmt::format("its field '{}' holds no sums of that many pixels", name));
  if (numbers.size() / 2 < blocks) throw wrong;
  std::vector<ExactSums> sums;
  sums.reserve(blocks);
  std::span<const uint32_t> left(numbers);
  for (size_t block = 0; block < blocks; ++block) {
    if (left.size() < 2 || (left.size() - 2) / ExactSums::kCount < left[1]) throw wrong;
    const std::span<const uint32_t> words = left.subspan(2, left[1] * ExactSums::kCount);
    try {
      sums.emplace_back(static_cast<int32_t>(left[0]), std::vector<uint32_t>(words.begin(), words.end()));
    } catch (const std::domain_error&) {
      throw wrong;
    }
    left = left.subspan(2 + words.size());
  }
  if (!left.empty()) throw wrong;
  return sums;
}

std::string corrections_name(const std::string& film, size_t group) {
  return fmt::format("{}.corrections.{}", film, group);
}
std::string layer_name(size_t number) { return fmt::format("layers.{}", number); }

void append_film(std::string& bytes, const std::string& name, const Film& film) {
  append_field(bytes, name + ".width", film.width());
  append_field(bytes, name + ".height", film.height());
  const FilmSums& sums = film.sums();
  append_field(bytes, name + ".passes", std::span<const PassRange>(sums.passes.ranges()));
  append_sums(bytes, name + ".values", sums.values);
  append_sums(bytes, name + ".squares", sums.squares);
  for (size_t g = 0; g < Film::kGroups; ++g) append_sums(bytes, corrections_name(name, g), sums.corrections[g]);
  append_sums(bytes, name + ".channel_means", {&sums.channel_means, 1});
}

Film take_film(NamedFields& fields, const std::string& name) {
  const int width = fields.take<int>(name + ".width"), height = fields.take<int>(name + ".height");
  if (std::min(width, height) < 1 || std::max(width, height) > kLargestFilm)
    throw FieldError(fmt::format("its {} has {} x {} pixels", name, width, height));
  const std::vector<PassRange> passes = fields.take_all<PassRange>(name + ".passes");
  if (!PassSet::is_valid(passes))
    throw FieldError(fmt::format("its field '{}.passes' holds no ranges in rising order", name));
  const size_t blocks = Film::blocks(width, height);
  FilmSums sums;
  sums.passes = PassSet(passes);
  sums.values = take_sums(fields, name + ".values", blocks);
  sums.squares = take_sums(fields, name + ".squares", blocks);
  for (size_t g = 0; g < Film::kGroups; ++g) sums.corrections[g] = take_sums(fields, corrections_name(name, g), blocks);
  sums.channel_means = take_sums(fields, name + ".channel_means", 1).front();
  return Film(width, height, std::move(sums));
}

std::vector<Film> take_layers(NamedFields& fields, const Film& whole) {
  std::vector<Film> layers;
  const auto number = fields.take<uint32_t>("layers");
  for (uint32_t i = 0; i < number; ++i) {
    layers.push_back(take_film(fields, layer_name(i)));
    const Film& layer = layers.back();
    if (layer.width() != whole.width() || layer.height() != whole.height() ||
        !(layer.sums().passes == whole.sums().passes))
      throw FieldError(fmt::format("its {} is not of the size and the passes of its film", layer_name(i)));
  }
  return layers;
}

void append_result(std::string& bytes, const RenderResult& result) {
  append_field(bytes, "seconds", result.seconds);
  append_field(bytes, "discs", std::span<const PixelDisc>(result.discs));
  append_counters(bytes, result.statistics);
  append_film(bytes, "film", result.film);
  append_field(bytes, "layers", static_cast<uint32_t>(result.layers.size()));
  for (size_t i = 0; i < result.layers.size(); ++i) append_film(bytes, layer_name(i), result.layers[i]);
}

RenderResult take_result(NamedFields fields) {
  RenderResult result{
      take_film(fields, "film"), {}, fields.take<double>("seconds"), fields.take_all<PixelDisc>("discs")};
  const size_t pixels = static_cast<size_t>(result.film.width()) * static_cast<size_t>(result.film.height());
  if (!result.discs.empty() && result.discs.size() < pixels)  // there are more where the film is a crop
    throw FieldError(fmt::format("its field 'discs' has {} numbers for {} pixels", result.discs.size(), pixels));
  result.layers = take_layers(fields, result.film);
  take_counters(fields, result.statistics);
  fields.refuse_others();
  return result;
}

/// What a checkpoint of these bytes holds, of which `rest` are fields and checksum.
RenderResult checked_result(const std::filesystem::path& path, std::string_view bytes, std::string_view rest) {
  const size_t sum_at = bytes.size() - std::min(rest.size(), kChecksum);
  if (checksum(bytes.substr(0, sum_at)) != bytes.substr(sum_at))
    refuse(path, "it is damaged or not whole: its checksum is wrong");
  try {
    return take_result(NamedFields(rest.substr(0, rest.size() - kChecksum)));
  } catch (const FieldError& error) {
    refuse(path, error.what());
  }
}

}  // namespace

Identity checkpoint_identity(const std::filesystem::path& path) {
  const std::string bytes = content_of(path);
  return parts_of(path, bytes).identity;
}

uint64_t checkpoint_bytes(const RenderJob& job) {
  const bool discs = pass_maker(job.scene, job.settings).ordered && facts_of(job.scene).rough_surfaces;
  const Camera& camera = job.scene.camera;
  const auto count = [](int width, int height) { return static_cast<uint64_t>(width) * static_cast<uint64_t>(height); };
  const PixelRect rendered = camera.rendered();
  const uint64_t layers = layer_films(job.settings) * Film::kBytesOfPlainPixel;
  return count(rendered.width(), rendered.height()) * (Film::kBytesOfPixel + layers) +
         (discs ? count(camera.width, camera.height) * sizeof(PixelDisc) : 0);
}

void write_checkpoint(const std::filesystem::path& path, const Identity& identity, const Origin& origin,
                      const RenderResult& result) {
  std::string bytes = fmt::format("{}\nformat {}\n", kKind, kCheckpointFormat) + lines_of(kIdentity, identity) +
                      lines_of(kOrigin, fields_of(origin));
  append_result(bytes, result);
  write_text(path, bytes + checksum(bytes));
}

std::string bytes_of(const RenderResult& result) {
  std::string bytes;
  append_result(bytes, result);
  return bytes;
}

RenderResult result_of(std::string_view bytes) { return take_result(NamedFields(bytes)); }

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  const std::string bytes = content_of(path);
  Parts parts = parts_of(path, bytes);
  return {std::move(parts.identity), std::move(parts.origin), checked_result(path, bytes, parts.rest)};
}

RenderResult read_checkpoint(const std::filesystem::path& path, const Identity& identity) {
  const std::string bytes = content_of(path);
  const Parts parts = parts_of(path, bytes);
  if (parts.identity != identity)
    refuse(path, "it is of another render; render on with the options that it began with" +
                     differences(parts.identity, identity, "in the checkpoint", "asked for"));
  return checked_result(path, bytes, parts.rest);
}

}  // namespace vpm
