// The ranks of a job: the little of MPI that breccia uses. One rank alone never meets MPI.
#pragma once
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "core/tables/column.hpp"

namespace breccia {

struct Ranks {
  int rank = 0, count = 1;

  bool alone() const { return count == 1; }
  bool is_root() const { return rank == 0; }
};

/// Ranks that a launcher (mpirun, srun) has started; alone without one.
Ranks ranks_of_launcher();

/// Begins and ends MPI; nothing when alone.
Ranks mpi_init();
void mpi_finalize();
/// Ends all ranks of the job at once.
[[noreturn]] void mpi_abort(int code);

/// Of several ranks: each gives its bytes, each has all of them, in the order of ranks.
/// @param bytes  that each rank gives
void all_gather(const Ranks& ranks, const void* mine, std::span<const std::size_t> bytes, void* all);
/// The same, on the root alone.
void gather_at_root(const Ranks& ranks, const void* mine, std::span<const std::size_t> bytes, void* all);
/// The root's bytes go to every rank.
void broadcast(const Ranks& ranks, void* data, std::size_t bytes);
/// The largest of every rank's values, on every rank, one by one.
void all_reduce_max(const Ranks& ranks, std::span<double> values);
/// True on every rank when it is on one.
bool any(const Ranks& ranks, bool here);
/// How much each rank gives.
std::vector<std::size_t> sizes_of_all(const Ranks& ranks, std::size_t mine);
std::size_t all_reduce_sum(const Ranks& ranks, std::size_t mine);
/// Returns when every rank has come here.
void barrier(const Ranks& ranks);

/// Of several ranks: each gives each some elements, every one of `bytes`; they come in the order of
/// ranks.
/// @param to, from  elements for, and of, each rank
void all_to_all(std::size_t bytes, const void* mine, std::span<const std::size_t> to, void* all,
                std::span<const std::size_t> from);
/// Of several ranks: how many elements each has for this one, where this one has `to` for each.
std::vector<std::size_t> sizes_for_me(std::span<const std::size_t> to);

/// Elements of each rank, one behind the other, at the root; empty elsewhere. T is copied as it
/// lies.
template <class T>
std::vector<T> gather_elements(const Ranks& ranks, std::span<const T> mine) {
  const std::vector<std::size_t> bytes = sizes_of_all(ranks, mine.size_bytes());
  const std::size_t total = std::accumulate(bytes.begin(), bytes.end(), std::size_t{0});
  std::vector<T> all(ranks.is_root() ? total / sizeof(T) : 0);
  gather_at_root(ranks, mine.data(), bytes, all.data());
  return all;
}

/// The same on every one of several ranks.
template <class T>
std::vector<T> gather_elements_everywhere(const Ranks& ranks, std::span<const T> mine) {
  const std::vector<std::size_t> bytes = sizes_of_all(ranks, mine.size_bytes());
  std::vector<T> all(std::accumulate(bytes.begin(), bytes.end(), std::size_t{0}) / sizeof(T));
  all_gather(ranks, mine.data(), bytes, all.data());
  return all;
}

/// What two ranks send each other at every step.
struct Neighbour {
  int rank = 0;
  std::vector<Row> send, receive;          ///< rows of particles, rising
  std::vector<double> outgoing, incoming;  ///< the numbers of them
};

/// Of several ranks: fills `send` of each neighbour: what the other side wants to receive of this
/// one.
/// @param neighbours  with `receive`, for every rank but this one
void exchange_send_lists(const Ranks& ranks, std::vector<Neighbour>& neighbours);

/// Sends every `outgoing` and asks for every `incoming`; neither may be touched until the exchange
/// is finished. One at a time.
void begin_exchange(std::vector<Neighbour>& neighbours);
/// Waits until all of it has gone and come. @returns false when none was begun
bool finish_exchange();

}  // namespace breccia
