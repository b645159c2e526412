#include "core/stdout_aside.hpp"

#include <fcntl.h>
#include <stdio_ext.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace lutka {

StdoutAside::StdoutAside() {
    std::cout.flush();
    std::fflush(stdout);
    kept_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (kept_ < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) >= 0) return;
    // Standard error is closed. Nor may the number be free for the next file that is opened.
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    ::dup2(nowhere, STDOUT_FILENO);
    ::close(nowhere);
}

StdoutAside::~StdoutAside() {
    if (kept_ < 0) return;
    const bool soundBefore = std::ferror(stdout) == 0;
    std::cout.flush();
    // What standard error didn't take must not come out of standard output later, nor count as its failure.
    if (std::fflush(stdout) != 0) ::__fpurge(stdout);
    if (soundBefore) std::clearerr(stdout);
    ::dup2(kept_, STDOUT_FILENO);
    ::close(kept_);
}

}  // namespace lutka
