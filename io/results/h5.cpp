#include "io/results/h5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

namespace breccia::h5 {
namespace {

/// Keeps the first error that HDF5 reports, which is the innermost: the walk goes from the cause
/// outwards.
herr_t take_first(unsigned depth, const H5E_error2_t* error, void* reason) {
  if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(reason) = error->desc;
  return 0;
}

std::string innermost_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &reason);
  // of "file write failed: time = ..., error message = 'No space left on device', ..." only the
  // message is news
  constexpr std::string_view mark = "error message = '";
  if (const std::size_t at = reason.find(mark); at != std::string::npos) {
    const std::size_t start = at + mark.size();
    reason = reason.substr(start, reason.find('\'', start) - start);
  }
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  return reason;
}

Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make an access list");
  check(H5Pset_file_locking(access, false, true), "do without locks");
  // Groups since HDF5 1.8 keep their links in one block; files since 1.10 refuse to be opened after
  // a kill.
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), "set the version");
  return access;
}

/// Links stay in the block of the group, and the block has room for so many: adding one overwrites,
/// allocates nothing.
void make_room(hid_t creation, unsigned links) {
  check(H5Pset_link_phase_change(creation, 65535, 65534), "keep links compact");
  check(H5Pset_est_link_info(creation, links, 12), "make room for links");
}

struct Types {
  hid_t memory, file;
};

Types types_of(Number number) {
  switch (number) {
    case Number::id:
      return {H5T_NATIVE_UINT64, H5T_STD_U64LE};
    case Number::byte:
      return {H5T_NATIVE_UINT8, H5T_STD_U8LE};
    case Number::real:
      break;
  }
  return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE};
}

/// Rows of a chunk: at most 16384, and shared out evenly, since a chunk is stored whole.
hsize_t rows_of_chunk(hsize_t rows) {
  const hsize_t chunks = (rows + 16383) / 16384;
  return (rows + chunks - 1) / chunks;
}

/// Deflate takes five times as long as writing, and gains little on positions and forces; on
/// histories, which are zero in most bonds, it is fast and gains nearly all. So: where every fourth
/// number repeats the one before.
bool is_worth_deflating(const Dataset& dataset) {
  if (dataset.number != Number::real) return true;
  const std::size_t rows = dataset.ranks.alone() ? dataset.rows : dataset.count;
  const std::span values(static_cast<const double*>(dataset.data), rows * dataset.components);
  std::size_t repeats = 0;
  for (std::size_t i = 1; i < values.size(); ++i) repeats += values[i] == values[i - 1] ? 1 : 0;
  return 4 * all_reduce_sum(dataset.ranks, repeats) >= dataset.rows * dataset.components;
}

/// Every rank its rows, all at once: a chunk that two of them share is put together on one.
void write_part(hid_t set, hid_t memory_type, int rank, const Dataset& dataset) {
  const char* name = dataset.name.c_str();
  const std::array<hsize_t, 2> first{dataset.first, 0}, count{dataset.count, dataset.components};
  const Handle there(H5Dget_space(set), H5Sclose, name);
  const Handle here(H5Screate_simple(rank, count.data(), nullptr), H5Sclose, name);
  check(dataset.count > 0
            ? H5Sselect_hyperslab(there, H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr)
            : H5Sselect_none(there),
        name);
  const Handle together(H5Pcreate(H5P_DATASET_XFER), H5Pclose, name);
  check(H5Pset_dxpl_mpio(together, H5FD_MPIO_COLLECTIVE), name);
  check(H5Dwrite(set, memory_type, here, there, together, dataset.data), name);
}

void write_scalar(hid_t object, const char* name, hid_t file_type, hid_t memory_type, const void* value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, name);
  const Handle attribute(H5Acreate2(object, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         name);
  check(H5Awrite(attribute, memory_type, value), name);
}

}  // namespace

void prepare() {
  // at the end of the program HDF5 would try again to write what a full disk has refused, and
  // crash
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void check(std::int64_t result, std::string_view doing) {
  if (result >= 0) return;
  const std::string reason = innermost_reason();
  throw Failure(reason.empty() ? fmt::format("HDF5 failed at \"{}\"", doing)
                               : fmt::format("{} (HDF5, at \"{}\")", reason, doing));
}

Handle open_file(const std::string& name) {
  return {H5Fopen(name.c_str(), H5F_ACC_RDWR, file_access()), H5Fclose, "open"};
}

Handle open_file(const std::string& name, const Ranks& ranks) {
  if (ranks.alone()) return open_file(name);
  const Handle access = file_access();
  check(H5Pset_fapl_mpio(access, MPI_COMM_WORLD, MPI_INFO_NULL), "open on all ranks");
  return {H5Fopen(name.c_str(), H5F_ACC_RDWR, access), H5Fclose, "open", true};
}

Handle open_to_read(const std::string& name) {
  return {H5Fopen(name.c_str(), H5F_ACC_RDONLY, file_access()), H5Fclose, "open"};
}

Handle create_file(const std::string& name, unsigned links_of_root) {
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "create");
  make_room(creation, links_of_root);
  return {H5Fcreate(name.c_str(), H5F_ACC_TRUNC, creation, file_access()), H5Fclose, "create"};
}

Handle create_group(hid_t parent, const std::string& name) {
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name};
}

Handle open_group(hid_t parent, const std::string& name) {
  return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, name};
}

bool has_link(hid_t parent, const std::string& name) {
  const htri_t there = H5Lexists(parent, name.c_str(), H5P_DEFAULT);
  check(there, name);
  return there > 0;
}

Handle create_unlinked_group(hid_t file, unsigned links) {
  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "make a group");
  make_room(creation, links);
  return {H5Gcreate_anon(file, creation, H5P_DEFAULT), H5Gclose, "make a group"};
}

void link_as(hid_t object, hid_t file, const std::string& parent, const std::string& name) {
  const Handle group(H5Gopen2(file, parent.c_str(), H5P_DEFAULT), H5Gclose, parent);
  const htri_t there = H5Lexists(group, name.c_str(), H5P_DEFAULT);
  check(there, name);
  if (there > 0) check(H5Ldelete(group, name.c_str(), H5P_DEFAULT), name);
  check(H5Olink(object, group, name.c_str(), H5P_DEFAULT, H5P_DEFAULT), name);
}

void flush(hid_t file) { check(H5Fflush(file, H5F_SCOPE_LOCAL), "flush"); }

void write_attribute(hid_t object, const char* name, double value) {
  write_scalar(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void write_attribute(hid_t object, const char* name, std::uint64_t value) {
  write_scalar(object, name, H5T_STD_U64LE, H5T_NATIVE_UINT64, &value);
}

void write_attribute(hid_t object, const char* name, std::string_view text) {
  // of variable length: h5py hands such a text on as str, one of fixed length as bytes; and no
  // limit at 64 kB
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, name);
  check(H5Tset_size(type, H5T_VARIABLE), name);
  check(H5Tset_cset(type, H5T_CSET_UTF8), name);
  const std::string ended(text);
  const char* value = ended.c_str();
  write_scalar(object, name, type, type, &value);
}

std::uint64_t read_id_attribute(hid_t object, const char* name) {
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, name);
  std::uint64_t value = 0;
  check(H5Aread(attribute, H5T_NATIVE_UINT64, &value), name);
  return value;
}

std::string read_text_attribute(hid_t object, const char* name) {
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, name);
  const Handle type(H5Aget_type(attribute), H5Tclose, name);
  char* value = nullptr;
  check(H5Aread(attribute, type, &value), name);
  std::string text(value == nullptr ? "" : value);
  H5free_memory(value);
  return text;
}

void write_dataset(hid_t group, const Dataset& dataset) {
  const char* name = dataset.name.c_str();
  const int rank = dataset.components > 1 ? 2 : 1;
  const std::array<hsize_t, 2> extent{dataset.rows, dataset.components};
  const Handle space(H5Screate_simple(rank, extent.data(), nullptr), H5Sclose, name);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
  if (dataset.rows > 0 && !dataset.plain) {
    const std::array<hsize_t, 2> chunk{rows_of_chunk(dataset.rows), dataset.components};
    check(H5Pset_chunk(creation, rank, chunk.data()), name);
    if (is_worth_deflating(dataset)) {
      check(H5Pset_shuffle(creation), name);
      check(H5Pset_deflate(creation, 1), name);
    }
    check(H5Pset_fletcher32(creation), name);
  }
  const Types types = types_of(dataset.number);
  const Handle set(H5Dcreate2(group, name, types.file, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
                   name);
  if (dataset.rows > 0 && dataset.ranks.alone())
    check(H5Dwrite(set, types.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, dataset.data), name);
  else if (dataset.rows > 0)
    write_part(set, types.memory, rank, dataset);
  if (!dataset.unit.empty()) write_attribute(set, "unit", dataset.unit);
  if (!dataset.role.empty()) write_attribute(set, "role", dataset.role);
  if (!dataset.meaning.empty()) write_attribute(set, "meaning", dataset.meaning);
}

std::size_t rows_of_dataset(hid_t group, const std::string& name, std::size_t components) {
  const Handle set(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, name);
  const Handle space(H5Dget_space(set), H5Sclose, name);
  std::array<hsize_t, 2> extent{0, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 2) throw Failure(name + " has another shape");
  check(H5Sget_simple_extent_dims(space, extent.data(), nullptr), name);
  if (extent[1] != components) throw Failure(name + " has another shape");
  return extent[0];
}

void read_dataset(hid_t group, const std::string& name, Number number, void* data) {
  const Handle set(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, name);
  check(H5Dread(set, types_of(number).memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), name);
}

}  // namespace breccia::h5
