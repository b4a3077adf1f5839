// A field's line: name, type, count and size of its numbers, so that all of it can be skipped by who does not know it.
#include "vpm/render/named_fields.h"

#include <fmt/format.h>
#include <array>
#include <cassert>
#include <charconv>

namespace vpm {
namespace {

/// The number that all of a text is; nothing where it is none.
bool parse(std::string_view text, size_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// The words between single spaces, of which there must be four.
bool split(std::string_view line, std::array<std::string_view, 4>& words) {
  for (size_t i = 0; i < words.size(); ++i) {
    const size_t end = i + 1 < words.size() ? line.find(' ') : line.size();
    if (end == std::string_view::npos || end == 0) return false;
    words[i] = line.substr(0, end);
    line.remove_prefix(std::min(line.size(), end + 1));
  }
  return words.back().find(' ') == std::string_view::npos;
}

}  // namespace

void append_field(std::string& bytes, std::string_view name, std::string_view type, size_t count,
                  std::span<const std::byte> numbers) {
  assert(!name.empty() && name.find_first_of(" \n") == std::string_view::npos);
  bytes += fmt::format("{} {} {} {}\n", name, type, count, numbers.size());
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size());
}

NamedFields::NamedFields(std::string_view bytes) {
  while (!bytes.empty()) {
    const size_t line = bytes.find('\n');
    std::array<std::string_view, 4> words;
    size_t count = 0, size = 0;
    if (line == std::string_view::npos || !split(bytes.substr(0, line), words) || !parse(words[2], count) ||
        !parse(words[3], size) || size > bytes.size() - line - 1 || (count == 0 ? size > 0 : size % count != 0))
      throw FieldError("it has bytes that are no field");
    const std::string name(words[0]);
    if (!fields_.try_emplace(name, Field{words[1], bytes.substr(line + 1, size), count}).second)
      throw FieldError(fmt::format("it has the field '{}' twice", name));
    bytes.remove_prefix(line + 1 + size);
  }
}

std::string_view NamedFields::take(const std::string& name, std::string_view type, size_t size) {
  const auto found = fields_.find(name);
  if (found == fields_.end()) throw FieldError(fmt::format("it has no field '{}'", name));
  Field& field = found->second;
  if (field.type != type || field.bytes.size() != field.count * size)
    throw FieldError(fmt::format("its field '{}' holds {} in {} bytes where {} of {} bytes each are read", name,
                                 field.type, field.bytes.size(), type, size));
  field.taken = true;
  return field.bytes;
}

void NamedFields::refuse_count(const std::string& name, size_t count) {
  throw FieldError(fmt::format("its field '{}' has {} numbers where one is read", name, count));
}

void NamedFields::refuse_others() const {
  for (const auto& [name, field] : fields_)
    if (!field.taken) throw FieldError(fmt::format("it has a field '{}', which this program does not know", name));
}

}  // namespace vpm
