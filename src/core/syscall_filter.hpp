#pragma once

namespace lutka {

/// From now on this process, and all that it might start, can't write, make, rename or remove files, open sockets,
/// start programs, or reach into other processes: such calls fail with EPERM. What is open already can be written to.
/// False where the kernel or the processor has no filter of system calls that we know; nothing has changed then.
bool forbidSideEffects();

}  // namespace lutka
