// Points at which a test makes a program wait, so that what a signal or a kill meets there is no
// matter of chance. Set from outside: BRECCIA_HOLD=POINT:COUNT=FILE. When the program comes to the
// point for the COUNT-th time, it writes its process id to FILE and waits until somebody removes
// FILE or a signal asks it to stop. Without the variable a point costs the look at one bool.
#pragma once
#include <cstddef>
#include <cstdint>

namespace breccia {

/// Their names in the variable are these, with a dash for the underscore.
enum class HoldPoint : std::uint8_t {
  packing,             ///< before spheres are packed
  step,                ///< after a step of the recorded stage of a test
  crack,               ///< a crack has been written to its file; counted one by one
  row,                 ///< between two rows of a curve, just before the run asks whether it is to stop
  frame,               ///< a frame is whole, in results.h5 and for ParaView
  run,                 ///< a run's curve and summary are written, the next one of the series has not begun
  results_claimed,     ///< results.h5 has grown by the room for a new group, nothing is in it
  results_filled,      ///< the group is written, not flushed, and nothing refers to it
  results_flushed,     ///< the group is flushed, nothing refers to it
  results_linked,      ///< the group has its name, the file is not closed
  checkpoint_begun,    ///< the checkpoint aside has its numbers, not its tables
  checkpoint_filled,   ///< it has all, but no checksum
  checkpoint_sealed,   ///< it is whole, the one before it still has the name
  checkpoint_between,  ///< the one before it has moved on, it has no name yet
  checkpoint,          ///< it has its name
  measurement,         ///< a study has written one more measurement to its files
};

/// Reads the value of BRECCIA_HOLD; nullptr or "" sets no hold.
/// @param stop  true once a signal has asked the program to stop: it then waits no longer
/// @throws BadInput for a value that names no point, no count or no file
void set_hold(const char* text, bool (*stop)());

namespace detail {
extern bool hold_is_set;
void arrive(HoldPoint point, std::size_t count);
}  // namespace detail

/// Says that the program has come to a point, or to `count` of them at once. Of several ranks the
/// root alone says so. Any thread may.
/// @throws WriteError when FILE cannot be written
inline void hold_at(HoldPoint point, std::size_t count = 1) {
  if (detail::hold_is_set) detail::arrive(point, count);
}

}  // namespace breccia
