// What a program does when it is asked to stop: end at once while nothing is lost, else finish the
// step and write what there is.
#pragma once

namespace breccia {

/// Makes SIGINT, SIGTERM, SIGUSR1 and SIGXCPU ask to stop, and lets a write that cannot happen
/// (SIGPIPE, SIGXFSZ) fail where its caller can say so.
void catch_signals();

/// True once SIGINT, SIGTERM, SIGUSR1 or SIGXCPU has come.
bool interrupted();

/// From here on a signal only makes `interrupted()` true; before, it ends the program at once.
void begin_results();

}  // namespace breccia
