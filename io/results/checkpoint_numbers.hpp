// How the numbers of core/loading/saved_state.hpp lie in a checkpoint: a dataset each, a row for
// each element, doubles or whole numbers. Written and read back to the same bits. Included by
// io/results/checkpoint.cpp alone.
#pragma once
#include <cstring>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/world/crack_record.hpp"
#include "io/results/h5.hpp"

namespace breccia {

/// An element as `components` numbers of one kind. Structures of doubles are taken as they lie;
/// those of other things have a specialisation.
template <class T>
struct Flat {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(double) == 0 &&
                alignof(T) == sizeof(double));
  using Number = double;
  static constexpr std::size_t components = sizeof(T) / sizeof(double);
  static void put(const T& value, double* to) { std::memcpy(to, &value, sizeof(T)); }
  static void take(T& value, const double* from) { std::memcpy(static_cast<void*>(&value), from, sizeof(T)); }
};

template <class T>
requires(std::is_integral_v<T> || std::is_enum_v<T>) struct Flat<T> {
  using Number = std::uint64_t;
  static constexpr std::size_t components = 1;
  static void put(const T& value, std::uint64_t* to) { *to = static_cast<std::uint64_t>(value); }
  static void take(T& value, const std::uint64_t* from) { value = static_cast<T>(*from); }
};

template <>
struct Flat<std::pair<Gid, Gid>> {
  using Number = std::uint64_t;
  static constexpr std::size_t components = 2;
  static void put(const std::pair<Gid, Gid>& value, std::uint64_t* to) {
    to[0] = value.first, to[1] = value.second;
  }
  static void take(std::pair<Gid, Gid>& value, const std::uint64_t* from) { value = {from[0], from[1]}; }
};

template <>
struct Flat<Vec3> {
  using Number = double;
  static constexpr std::size_t components = 3;
  static void put(const Vec3& v, double* to) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }
  static void take(Vec3& v, const double* from) { v = {from[0], from[1], from[2]}; }
};

template <std::size_t n>
struct Flat<std::array<Vec3, n>> {
  using Number = double;
  static constexpr std::size_t components = 3 * n;
  static void put(const std::array<Vec3, n>& value, double* to) {
    for (const Vec3& v : value) Flat<Vec3>::put(v, to), to += 3;
  }
  static void take(std::array<Vec3, n>& value, const double* from) {
    for (Vec3& v : value) Flat<Vec3>::take(v, from), from += 3;
  }
};

/// A crack has both kinds. Its ends are stored apart, as whole numbers: a double holds ids only up
/// to 2^53.
template <>
struct Flat<Crack> {
  using Number = double;
  static constexpr std::size_t components = 13;
  static void put(const Crack& c, double* to) {
    const double all[components] = {c.time,         c.axial_strain, c.position.x,
                                    c.position.y,   c.position.z,   c.normal.x,
                                    c.normal.y,     c.normal.z,     static_cast<double>(c.mode),
                                    c.normal_force, c.shear_force,  c.area,
                                    c.energy};
    std::memcpy(to, all, sizeof(all));
  }
  static void take(Crack& c, const double* f) {
    c = {f[0], f[1],  0,     0,    {f[2], f[3], f[4]}, {f[5], f[6], f[7]}, static_cast<BondState>(f[8]),
         f[9], f[10], f[11], f[12]};
  }
};

using CrackEnds = std::pair<Gid, Gid>;
inline std::string name_of_ends(const char* name) { return std::string(name) + "_ends"; }

template <class Number>
constexpr h5::Number kind_of = std::is_same_v<Number, double> ? h5::Number::real : h5::Number::id;

struct NumberWriter {
  hid_t group;

  template <class T, class Allocator>
  void operator()(const char* name, const std::vector<T, Allocator>& values) const {
    write(name, values.data(), values.size());
  }
  template <class Allocator>
  void operator()(const char* name, const std::vector<Crack, Allocator>& cracks) const {
    std::vector<CrackEnds> ends;
    for (const Crack& c : cracks) ends.emplace_back(c.gid_lo, c.gid_hi);
    write(name, cracks.data(), cracks.size());
    write(name_of_ends(name).c_str(), ends.data(), ends.size());
  }
  template <class T>
  void operator()(const char* name, const T& value) const {
    write(name, &value, 1);
  }

private:
  template <class T>
  void write(const char* name, const T* values, std::size_t count) const {
    using Number = typename Flat<T>::Number;
    constexpr std::size_t components = Flat<T>::components;
    std::vector<Number> flat(count * components);
    for (std::size_t k = 0; k < count; ++k) Flat<T>::put(values[k], &flat[k * components]);
    h5::write_dataset(group, {.name = name,
                              .unit = {},
                              .role = {},
                              .meaning = {},
                              .number = kind_of<Number>,
                              .rows = count,
                              .components = components,
                              .data = flat.data(),
                              .plain = true});
  }
};

/// What all of them take in the file, with the header of a dataset for each.
struct NumberCounter {
  std::size_t bytes = 0;

  template <class T, class Allocator>
  void operator()(const char*, const std::vector<T, Allocator>& values) {
    add<T>(values.size());
  }
  template <class Allocator>
  void operator()(const char*, const std::vector<Crack, Allocator>& cracks) {
    add<Crack>(cracks.size());
    add<CrackEnds>(cracks.size());
  }
  template <class T>
  void operator()(const char*, const T&) {
    add<T>(1);
  }

private:
  template <class T>
  void add(std::size_t count) {
    constexpr std::size_t header = 1024;
    bytes += header + count * Flat<T>::components * sizeof(typename Flat<T>::Number);
  }
};

struct NumberReader {
  hid_t group;

  template <class T, class Allocator>
  void operator()(const char* name, std::vector<T, Allocator>& values) const {
    values.resize(h5::rows_of_dataset(group, name, Flat<T>::components));
    read(name, values.data(), values.size());
  }
  template <class Allocator>
  void operator()(const char* name, std::vector<Crack, Allocator>& cracks) const {
    const std::string ends_name = name_of_ends(name);
    cracks.resize(h5::rows_of_dataset(group, name, Flat<Crack>::components));
    std::vector<CrackEnds> ends(h5::rows_of_dataset(group, ends_name, Flat<CrackEnds>::components));
    if (ends.size() != cracks.size()) throw h5::Failure(ends_name + " has another number of rows");
    read(name, cracks.data(), cracks.size());
    read(ends_name.c_str(), ends.data(), ends.size());
    for (std::size_t k = 0; k < ends.size(); ++k) std::tie(cracks[k].gid_lo, cracks[k].gid_hi) = ends[k];
  }
  template <class T>
  void operator()(const char* name, T& value) const {
    if (h5::rows_of_dataset(group, name, Flat<T>::components) != 1)
      throw h5::Failure(std::string(name) + " has another number of rows");
    read(name, &value, 1);
  }

private:
  template <class T>
  void read(const char* name, T* values, std::size_t count) const {
    using Number = typename Flat<T>::Number;
    constexpr std::size_t components = Flat<T>::components;
    std::vector<Number> flat(count * components);
    if (count > 0) h5::read_dataset(group, name, kind_of<Number>, flat.data());
    for (std::size_t k = 0; k < count; ++k) Flat<T>::take(values[k], &flat[k * components]);
  }
};

}  // namespace breccia
