// The little of HDF5 that breccia uses: handles that close themselves, and errors as one exception
// with one cause. Included by the .cpp files that write or read HDF5, by no header.
#pragma once
#include <hdf5.h>

#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "core/ranks/mpi.hpp"

namespace breccia::h5 {

/// What HDF5 could not do, and why; without the name of the file, which the caller knows.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Before any other call: HDF5 neither prints its own stack of errors nor writes on when the
/// program ends. Calling it again costs nothing.
void prepare();

/// @throws Failure with `doing` and HDF5's innermost reason, when `result` is negative
void check(std::int64_t result, std::string_view doing);

/// Owns an HDF5 id.
class Handle {
public:
  using Close = herr_t (*)(hid_t);
  /// @throws Failure when id is negative, as HDF5's functions return where they fail
  /// @param shared  by several ranks: where one of them alone fails, it must not wait for the
  ///         others to close
  Handle(hid_t id, Close closer, std::string_view doing, bool shared = false)
      : id_(id), close_(closer), shared_(shared) {
    check(id, doing);
  }
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), close_(other.close_), shared_(other.shared_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0 && !(shared_ && std::uncaught_exceptions() > 0)) close_(id_);
  }
  operator hid_t() const { return id_; }
  /// Closes now, and says when that fails: a file is written in earnest only when it is closed.
  void close(std::string_view doing) { check(close_(std::exchange(id_, -1)), doing); }

private:
  hid_t id_;
  Close close_;
  bool shared_;
};

/// Opens an existing file to be changed, or makes a new one. Without HDF5's own locks: a run must
/// not stop because someone looks at its results.
Handle open_file(const std::string& name);
/// Of several ranks, on all of them together: whatever is done with the file, all must do, in the
/// same order.
Handle open_file(const std::string& name, const Ranks& ranks);
Handle open_to_read(const std::string& name);
Handle create_file(const std::string& name, unsigned links_of_root);

Handle create_group(hid_t parent, const std::string& name);
Handle open_group(hid_t parent, const std::string& name);
bool has_link(hid_t parent, const std::string& name);

/// A group that nothing refers to yet: until it is linked, the file around it is as it was.
/// @param links  that it will hold; room for them is set aside in the group itself
Handle create_unlinked_group(hid_t file, unsigned links);

/// Gives an unlinked group its place; one that has the name already is let go.
void link_as(hid_t object, hid_t file, const std::string& parent, const std::string& name);

void flush(hid_t file);

void write_attribute(hid_t object, const char* name, double value);
void write_attribute(hid_t object, const char* name, std::uint64_t value);
void write_attribute(hid_t object, const char* name, std::string_view text);  ///< of any length, UTF-8

std::uint64_t read_id_attribute(hid_t object, const char* name);
std::string read_text_attribute(hid_t object, const char* name);

/// Numbers that a dataset can hold, in memory and in the file.
enum class Number { real, id, byte };

/// A dataset, or the part of it that one rank writes: rows x components numbers with the attributes
/// unit, role and meaning (left out where they are empty); checksummed and, where it pays,
/// deflated.
struct Dataset {
  std::string name;
  std::string_view unit, role, meaning;
  Number number = Number::real;
  std::size_t rows = 0, components = 1;  ///< of all ranks
  const void* data = nullptr;
  Ranks ranks = {};                  ///< that have the file open
  std::size_t first = 0, count = 0;  ///< of several ranks: rows that this one has
  bool plain = false;                ///< as it is, in one piece: for files that carry a checksum of their own
};
void write_dataset(hid_t group, const Dataset& dataset);

/// Rows of a dataset of so many components a row. @throws Failure when it has another shape
std::size_t rows_of_dataset(hid_t group, const std::string& name, std::size_t components);
/// Reads all of it. @param data  room for rows x components
void read_dataset(hid_t group, const std::string& name, Number number, void* data);

}  // namespace breccia::h5
