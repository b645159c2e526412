#pragma once

namespace lutka::cli {

/// From now on Ctrl+C, a hang-up or a polite kill asks the program to stop instead of ending it on the spot, so that
/// temporary files are removed; a second signal, half a second or more after the first, ends it at once, and when
/// nothing has heeded the first after 0.7 s, the program ends by itself; temporary files go either way, and encoders
/// with them. A closed pipe is an error of writing from now
/// on.
void installInterruptHandler();

/// Whether a signal asked the program to stop.
[[nodiscard]] bool interrupted();

/// Leaves with the shell's code for the signal (128 + its number) when one came.
void leaveIfInterrupted();

}  // namespace lutka::cli
