#pragma once

#include <sys/types.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace lutka::render {

/// A program that reads our bytes on its standard input; what it says on standard error is kept. Killed when dropped
/// before finish().
class ChildProcess {
  public:
    struct Ended {
        bool succeeded = false;  ///< Exit status 0.
        std::string errorText;   ///< Standard error, its last lines, on one line.
    };

    /// Starts arguments[0], looked up on the PATH, with those arguments. Fails with ErrorCode::output.
    [[nodiscard]] static Result<ChildProcess> start(const std::vector<std::string>& arguments);

    /// Whether a program of that name is executable somewhere on the PATH.
    [[nodiscard]] static bool isOnPath(const std::string& program);

    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&&) = delete;
    ~ChildProcess();

    /// Feeds the program; blocks while it is busy. False when it has closed its input.
    [[nodiscard]] bool write(std::span<const std::uint8_t> bytes);

    /// Closes its input and waits for its end.
    [[nodiscard]] Ended finish();

    /// Kills all programs that were started and not waited for, and waits until they are gone, for a process that is
    /// about to end by a signal: safe in a signal handler. None may be used after it.
    static void killAll() noexcept;

  private:
    ChildProcess(pid_t pid, int input, int errors) : pid_(pid), input_(input), errors_(errors) {}

    pid_t pid_ = -1;
    int input_ = -1;   ///< Our end of the socket that is its standard input.
    int errors_ = -1;  ///< An unlinked file that is its standard error.
};

}  // namespace lutka::render
