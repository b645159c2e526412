#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <string>

namespace lutka::test {

/// Standard output and error lead to files, both to one where they are the same, or are closed where one has no name,
/// until the end of the scope.
class OtherStreams {
  public:
    explicit OtherStreams(const std::string& file) : OtherStreams(file, file) {}
    OtherStreams(const std::string& out, const std::string& err) {
        std::fflush(nullptr);
        const std::array<const std::string*, 2> files{&out, &err};
        for (int i = 0; i < 2; ++i) {
            const int stream = STDOUT_FILENO + i;
            kept_[i] = ::fcntl(stream, F_DUPFD_CLOEXEC, 10);
            ::close(stream);
            if (files[i]->empty()) continue;
            const int opened = ::open(files[i]->c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
            if (opened == stream) continue;
            ::dup2(opened, stream);
            ::close(opened);
        }
    }
    OtherStreams(const OtherStreams&) = delete;
    OtherStreams& operator=(const OtherStreams&) = delete;
    ~OtherStreams() {
        std::fflush(nullptr);
        for (int i = 0; i < 2; ++i) {
            ::dup2(kept_[i], STDOUT_FILENO + i);
            ::close(kept_[i]);
        }
    }

  private:
    std::array<int, 2> kept_{};
};

}  // namespace lutka::test
