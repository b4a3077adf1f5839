// Numbers under names, as bytes: for each field a line of its name, type and count, then the numbers as they stand in
// memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace vpm {

/// What a type is called in a field; specialised for each that fields may hold, of no bytes without meaning.
template <class T>
inline constexpr std::string_view kFieldType = "";
template <>
inline constexpr std::string_view kFieldType<int32_t> = "i32";
template <>
inline constexpr std::string_view kFieldType<int64_t> = "i64";
template <>
inline constexpr std::string_view kFieldType<uint32_t> = "u32";
template <>
inline constexpr std::string_view kFieldType<uint64_t> = "u64";
template <>
inline constexpr std::string_view kFieldType<float> = "f32";
template <>
inline constexpr std::string_view kFieldType<double> = "f64";

template <class T>
concept FieldNumber = std::is_standard_layout_v<T> && std::is_trivially_destructible_v<T> && !kFieldType<T>.empty();

/// Fields that are not those that are asked for. The message says which and why.
class FieldError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Appends a field. The name has neither spaces nor line feeds.
void append_field(std::string& bytes, std::string_view name, std::string_view type, size_t count,
                  std::span<const std::byte> numbers);
template <FieldNumber T>
void append_field(std::string& bytes, std::string_view name, std::span<const T> numbers) {
  append_field(bytes, name, kFieldType<T>, numbers.size(), std::as_bytes(numbers));
}
template <FieldNumber T>
void append_field(std::string& bytes, std::string_view name, const T& number) {
  append_field(bytes, name, std::span<const T>(&number, 1));
}

/// Fields, to be taken by name.
class NamedFields {
 public:
  /// Throws FieldError where the bytes, which must outlive it, are no fields, or two of one name.
  explicit NamedFields(std::string_view bytes);

  /// The numbers of a field. Throws FieldError where there is none of that name, or of another type.
  template <FieldNumber T>
  std::vector<T> take_all(const std::string& name) {
    const std::string_view bytes = take(name, kFieldType<T>, sizeof(T));
    std::vector<T> numbers(bytes.size() / sizeof(T));
    bytes.copy(reinterpret_cast<char*>(numbers.data()), bytes.size());
    return numbers;
  }
  /// The one number of a field. Throws FieldError also where it has more or none.
  template <FieldNumber T>
  T take(const std::string& name) {
    const std::vector<T> numbers = take_all<T>(name);
    if (numbers.size() != 1) refuse_count(name, numbers.size());
    return numbers[0];
  }
  /// Throws FieldError where a field has not been taken.
  void refuse_others() const;

 private:
  struct Field {
    std::string_view type, bytes;
    size_t count = 0;
    bool taken = false;
  };
  std::string_view take(const std::string& name, std::string_view type, size_t size);
  [[noreturn]] static void refuse_count(const std::string& name, size_t count);

  std::map<std::string, Field, std::less<>> fields_;
};

}  // namespace vpm
