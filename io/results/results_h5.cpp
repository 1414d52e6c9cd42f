#include "io/results/results_h5.hpp"

#include <fmt/format.h>

#include <system_error>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/hold.hpp"
#include "io/files/atomic_write.hpp"
#include "io/files/disk_space.hpp"
#include "io/files/write_error.hpp"
#include "io/results/h5_columns.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

bool stays(Role role) { return role == Role::identity || role == Role::reference; }
bool changes(Role role) { return role == Role::history || role == Role::state || role == Role::derived; }

void write_states(hid_t group, const BondTable& bonds, const FileOrder& order) {
  const auto states = in_file_order<std::uint8_t>(
      order, [&](Row row) { return static_cast<std::uint8_t>(bond_state(bonds, row)); });
  const ColumnInfo info{"BondState", "state",      "1",
                        Role::state, Need::always, "0 intact, 1 broken in tension, 2 broken in shear"};
  write_rows(group, info, "derived", order, states, false);
}

/// The most that so many rows of these columns can take in the file: they are stored as they are
/// where deflate gains nothing.
template <class Table>
std::size_t bytes_of(const Table& table, std::size_t rows, bool (*wanted)(Role)) {
  std::size_t bytes = 0;
  table.for_each_column([&](const ColumnInfo& info, const auto& column) {
    using T = ValueOf<decltype(column)>;
    // 8 kB: header, attributes, index of chunks; 1/256: check sums, last rows of chunks, index of
    // many chunks
    if (wanted(info.role) && !column.empty()) bytes += rows * sizeof(T) * 257 / 256 + 8192;
  });
  return bytes;
}

std::size_t owned_rows(const Partition& partition) {
  return partition.owned().last - partition.owned().first;
}

constexpr std::size_t bytes_of_group = 65536;  ///< of the groups around the datasets, and their attributes
constexpr unsigned usual_runs = 64, usual_frames = 128;  ///< more are possible, at a little more risk (below)

// HDF5 changes a file in place: left to itself, a full disk or a kill half-way makes the older
// frames unreadable too (tried: "addr overflow" when they are listed; its exit handler may crash on
// top). So the space is claimed before HDF5 opens the file, and HDF5 gives back what it did not
// need. A process that dies in between leaves a file that is too long, which HDF5 accepts, never
// one that is too short. And a new group is written and flushed behind everything else before
// anything refers to it. What is overwritten in place after that is the block of links of its
// parent, which has room for one more.

/// Adds the group parent/name, made for so many links, filled by `write(group)` on all ranks.
/// @param bytes  of columns at most, on this rank
template <class Write>
void append(const fs::path& path, const Ranks& ranks, const std::string& parent, const std::string& name,
            std::size_t bytes, unsigned links, Write&& write) {
  h5::prepare();
  bytes = all_reduce_sum(ranks, bytes);
  if (ranks.is_root()) preallocate(path, bytes + bytes_of_group);
  const auto hold = [&](HoldPoint point) {
    if (ranks.is_root()) hold_at(point);
  };
  hold(HoldPoint::results_claimed);
  barrier(ranks);
  try {
    h5::Handle file = h5::open_file(path.string(), ranks);
    {
      const h5::Handle group = h5::create_unlinked_group(file, links);
      write(static_cast<hid_t>(group));
      hold(HoldPoint::results_filled);
      h5::flush(file);
      hold(HoldPoint::results_flushed);
      h5::link_as(group, file, parent, name);
      hold(HoldPoint::results_linked);
    }  // a file closes only after its groups
    file.close("close");
  } catch (const h5::Failure& failure) {
    fail_to_write(path, failure.what());
  }
  if (ranks.is_root()) flush_to_disk(path);
}

std::string name_of_run(int run) { return fmt::format("run-{}", run); }

}  // namespace

void create_results(const fs::path& file, std::string_view case_text) {
  h5::prepare();
  const fs::path aside = name_aside(file);
  atomic_write(aside, "");
  try {
    // a full disk is better told by the system than by HDF5
    preallocate(aside, case_text.size() + bytes_of_group);
    h5::Handle made = h5::create_file(aside.string(), usual_runs);
    h5::write_attribute(made, "version", std::string_view(BRECCIA_VERSION));
    h5::write_attribute(made, "case", case_text);
    made.close("close");
  } catch (const std::exception& error) {
    std::error_code ignored;
    fs::remove(aside, ignored);
    if (dynamic_cast<const h5::Failure*>(&error) != nullptr) fail_to_write(file, error.what());
    throw;
  }
  move_into_place(aside, file);
}

void begin_run(const fs::path& file, int run, std::span<const std::pair<std::string, double>> attributes,
               const Partition& partition, const ParticleTable& particles, const BondTable& bonds) {
  const std::size_t bytes =
      bytes_of(particles, owned_rows(partition), stays) + bytes_of(bonds, bonds.size, stays);
  append(file, partition.ranks, "/", name_of_run(run), bytes, usual_frames, [&](hid_t group) {
    for (const auto& [key, value] : attributes) h5::write_attribute(group, key.c_str(), value);
    write_columns(h5::create_group(group, "particles"), particles, file_order(partition, particles), stays,
                  false);
    write_columns(h5::create_group(group, "bonds"), bonds, file_order(partition, bonds), stays, false);
  });
}

bool has_run(const fs::path& file, int run) {
  h5::prepare();
  try {
    return h5::has_link(h5::open_to_read(file.string()), name_of_run(run));
  } catch (const h5::Failure& failure) {
    fail<WriteError>("{}: cannot be read: {}", file.string(), failure.what());
  }
}

void append_frame(const fs::path& file, int run, int frame, const FrameStamp& stamp,
                  const Partition& partition, const ParticleTable& particles, const BondTable& bonds) {
  const std::string name = fmt::format("frame-{:03}", frame);
  const std::size_t bytes = bytes_of(particles, owned_rows(partition), changes) +
                            bytes_of(bonds, bonds.size, changes) + bonds.size + 8192;
  append(file, partition.ranks, name_of_run(run), name, bytes, 2, [&](hid_t group) {
    h5::write_attribute(group, "time_s", stamp.time_s);
    h5::write_attribute(group, "step", stamp.step);
    h5::write_attribute(group, "axial_strain", stamp.axial_strain);
    write_columns(h5::create_group(group, "particles"), particles, file_order(partition, particles), changes,
                  false);
    const h5::Handle bond_group = h5::create_group(group, "bonds");
    const FileOrder order = file_order(partition, bonds);
    write_columns(bond_group, bonds, order, changes, false);
    write_states(bond_group, bonds, order);
  });
}

}  // namespace breccia
