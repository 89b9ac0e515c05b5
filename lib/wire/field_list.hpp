#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>

#include "lib/wire/byte_stream.hpp"

namespace morepro::wire {

/// The fields of struct T in the order of the wire, as pointers to members: one list that writing, reading
/// and the size follow. A specialisation stands beside each codec; is_whole() finds a field that the list
/// forgot.
template <class T>
inline constexpr auto kFields = std::tuple<>{};

/// Whether `value` is one of the enumerators; specialised for every enumeration on the wire, as a switch
/// without default, so that the compiler finds a forgotten enumerator.
template <class E>
requires std::is_enum_v<E>
constexpr bool is_known(E value) = delete;

namespace detail {

struct AnyValue {
  template <class T>
  operator T() const;  // NOLINT(google-explicit-constructor): stands for a value of any type
};

template <class T, std::size_t... kIndex>
constexpr bool takes_fields(std::index_sequence<kIndex...>) {
  return requires { T{{(static_cast<void>(kIndex), AnyValue{})}...}; };
}

template <class T>
constexpr BitsOf<T> bits_of_value(T value) {
  if constexpr (std::is_floating_point_v<T>)
    return canonical_bits(value);
  else
    return static_cast<BitsOf<T>>(value);
}

/// Returns false where `bits` mean nothing in type T.
template <class T>
constexpr bool set_from_bits(T& value, BitsOf<T> bits) {
  if constexpr (std::is_floating_point_v<T>)
    value = std::bit_cast<T>(bits);
  else
    value = static_cast<T>(bits);
  if constexpr (std::is_enum_v<T>) return is_known(value);
  if constexpr (std::is_same_v<T, bool>) return bits <= 1;
  return true;
}

template <class T>
inline constexpr bool kIsStdArray = false;
template <class T, std::size_t kSize>
inline constexpr bool kIsStdArray<std::array<T, kSize>> = true;

}  // namespace detail

/// Number of fields of aggregate T, counted by the compiler.
template <class T, std::size_t kCount = 0>
constexpr std::size_t field_count() {
  if constexpr (detail::takes_fields<T>(std::make_index_sequence<kCount + 1>{}))
    return field_count<T, kCount + 1>();
  else
    return kCount;
}

/// kFields<T> names as many fields as T has.
template <class T>
constexpr bool is_whole() {
  return std::tuple_size_v<std::remove_const_t<decltype(kFields<T>)>> == field_count<T>();
}

/// Bytes of T on the wire: fixed, without padding.
template <class T>
constexpr std::size_t wire_size() {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    return sizeof(T);
  } else if constexpr (detail::kIsStdArray<T>) {
    return std::tuple_size_v<T> * wire_size<typename T::value_type>();
  } else {
    static_assert(is_whole<T>(), "a field of this struct is missing in its kFields");
    return std::apply(
        [](auto... field) {
          return (wire_size<std::decay_t<decltype(std::declval<T&>().*field)>>() + ... + 0U);
        },
        kFields<T>);
  }
}

namespace detail {

template <class T>
std::uint8_t* store(std::uint8_t* place, const T& value) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    store_little_endian(place, bits_of_value(value));
    place += sizeof(T);
  } else if constexpr (kIsStdArray<T>) {
    for (const auto& element : value) place = store(place, element);
  } else {
    std::apply([&](auto... field) { ((place = store(place, value.*field)), ...); }, kFields<T>);
  }
  return place;
}

/// Returns false where an enumeration or a bool holds what it cannot hold.
template <class T>
bool load(const std::uint8_t*& place, T& value) {
  bool known = true;
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    known = set_from_bits(value, load_little_endian<BitsOf<T>>(place));
    place += sizeof(T);
  } else if constexpr (kIsStdArray<T>) {
    for (auto& element : value) known = load(place, element) && known;
  } else {
    std::apply([&](auto... field) { ((known = load(place, value.*field) && known), ...); }, kFields<T>);
  }
  return known;
}

}  // namespace detail

/// Appends every field of `value`. The room is checked once, for all of them.
template <class T>
void write_fields(ByteWriter& writer, const T& value) {
  if (std::uint8_t* place = writer.reserve(wire_size<T>())) detail::store(place, value);
}

/// Takes every field of `value`. The length is checked once, for all of them.
template <class T>
void read_fields(ByteReader& reader, T& value) {
  const auto bytes = reader.take(wire_size<T>());
  if (bytes.empty()) return;
  const std::uint8_t* place = bytes.data();
  if (!detail::load(place, value)) reader.reject();
}

}  // namespace morepro::wire
