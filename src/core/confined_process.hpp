#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace lutka {

/// What a confined process may use. Reading files is allowed; writing any, networks and other programs are not.
struct ProcessLimits {
    std::size_t memoryBytes = std::size_t{3} << 29U;  ///< Address space: 1.5 GiB.
    int seconds = 20;                                 ///< Of processor time, and of time on the wall.
    std::size_t stackBytes = std::size_t{64} << 20U;
    int openFiles = 64;
};

/// How a confined process ended.
struct ProcessEnd {
    enum class Kind {
        finished,     ///< By itself, with `exitCode`; `output` is whole.
        crashed,      ///< By signal number `signal`.
        outOfTime,    ///< Killed after the limit's seconds, of the processor or on the wall.
        tooMuchSaid,  ///< Killed: it wrote more than its own memory limit.
        stopped,      ///< Killed because `stop` said so.
    };
    Kind kind = Kind::finished;
    int exitCode = 0;
    int signal = 0;
    std::string output;   ///< What it wrote to its handle kConfinedOutput; empty when it was killed.
    std::string printed;  ///< What it printed, on standard output and error alike: the last kMostPrinted bytes.
};

/// The handle that a confined process writes its result to.
inline constexpr int kConfinedOutput = 3;

/// So many bytes of what a confined process prints are kept.
inline constexpr std::size_t kMostPrinted = std::size_t{16} << 10U;

/// Runs a program that calls confineThisProcess() first thing, and collects what it writes to kConfinedOutput and what
/// it prints. Neither depends on our own standard streams, which may be files, full or closed: it may write no file,
/// and is never held up by what it prints (what can't be taken at once is lost). `arguments[0]` is the program's path.
/// `stop` is asked ten times a second. Fails with ErrorCode::internal when the program can't be started.
[[nodiscard]] Result<ProcessEnd> runConfined(const std::vector<std::string>& arguments, const ProcessLimits& limits,
                                             const std::function<bool()>& stop = {});

/// Takes from this process, for good, what it has beyond the limits: closes all handles but the standard ones and
/// kConfinedOutput, sets the resource limits, ends it with its parent, and where the kernel has seccomp forbids to
/// write, make, rename or remove files, to open sockets and to start programs. For a process of its own, before it
/// opens anything that is not trusted.
void confineThisProcess(const ProcessLimits& limits);

}  // namespace lutka
