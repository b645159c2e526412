#pragma once

namespace lutka::cli {

/// Gives the process three standard streams when it was started with some of them closed: otherwise the next file that
/// is opened takes the free number, and what we print goes into the user's file. Printing to a closed stream still
/// fails.
void openStandardStreams();

/// What was printed to stdout and is still in buffers is written now. False when it, or anything before it, could not
/// be written: a full disk, a closed pipe.
[[nodiscard]] bool flushStandardOutput();

}  // namespace lutka::cli
