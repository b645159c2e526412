#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <functional>
#include <new>
#include <string>
#include <vector>

#include "core/confined_process.hpp"
#include "core/syscall_filter.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;

namespace {

ProcessEnd shell(const std::string& script, const ProcessLimits& limits = {}) {
    auto end = runConfined({"/bin/sh", "-c", script}, limits);
    REQUIRE(end);
    return std::move(end).value();
}

// The exit code of a child that does this and is then gone.
int codeOfChild(const std::function<int()>& body) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(body());
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

TEST_CASE("what a process writes to its result handle is collected, and what it prints is not") {
    const ProcessEnd end = shell("echo chatter; printf result >&3; exit 7");
    CHECK(end.kind == ProcessEnd::Kind::finished);
    CHECK(end.exitCode == 7);
    CHECK(end.output == "result");
    CHECK(end.printed == "chatter\n");
    CHECK(shell("head -c 3000000 /dev/zero >&3").output.size() == 3'000'000);
}

TEST_CASE("a process that crashes, hangs or talks without end is told apart") {
    const ProcessEnd crashed = shell("kill -SEGV $$");
    CHECK(crashed.kind == ProcessEnd::Kind::crashed);
    CHECK(crashed.signal == SIGSEGV);
    ProcessLimits brief;
    brief.seconds = 1;
    CHECK(shell("exec sleep 60", brief).kind == ProcessEnd::Kind::outOfTime);
    CHECK(shell("exec 3>&-; exec sleep 60", brief).kind == ProcessEnd::Kind::outOfTime);
    ProcessLimits small;
    small.memoryBytes = 1000;
    CHECK(shell("exec cat /dev/zero >&3", small).kind == ProcessEnd::Kind::tooMuchSaid);
    const auto stopped = runConfined({"/bin/sh", "-c", "exec sleep 60"}, {}, [] { return true; });
    REQUIRE(stopped);
    CHECK(stopped.value().kind == ProcessEnd::Kind::stopped);
}

TEST_CASE("both standard streams are collected, whatever becomes of the process, and the last of them is kept") {
    CHECK(shell("echo one; echo two >&2; printf result >&3").printed == "one\ntwo\n");
    CHECK(shell("exec 3>&-; echo late").printed == "late\n");
    const ProcessEnd crashed = shell("echo assertion >&2; kill -ABRT $$");
    CHECK(crashed.signal == SIGABRT);
    CHECK(crashed.printed == "assertion\n");
    const test::ScratchFolder folder;
    const std::string said = folder / "said";
    const auto stopped = runConfined({"/bin/sh", "-c", "echo waiting; echo >'" + said + "'; exec sleep 60"}, {},
                                     [&] { return std::filesystem::exists(said); });
    REQUIRE(stopped);
    CHECK(stopped.value().kind == ProcessEnd::Kind::stopped);
    CHECK(stopped.value().printed == "waiting\n");
    const ProcessEnd loud = shell("head -c 3000000 /dev/zero; printf result >&3");
    CHECK(loud.output == "result");
    CHECK(loud.printed.size() <= kMostPrinted);
}

TEST_CASE("a process that prints is not held up by a parent that doesn't listen") {
    // Never asked for what it prints before it ended: the parent is held up in `stop`, until the other has gone
    // through.
    const test::ScratchFolder folder;
    const std::string done = folder / "done";
    const auto end = runConfined(
        {"/bin/sh", "-c", "head -c 3000000 /dev/zero 2>&-; echo >'" + done + "'; printf result >&3"}, {}, [&] {
            while (!std::filesystem::exists(done))
                ::usleep(1000);
            return false;
        });
    REQUIRE(end);
    CHECK(end.value().output == "result");
}

TEST_CASE("a confined process has its own streams where ours are closed") {
    const std::string script = "echo chatter; cat; printf result >&3";
    for (int closed = 1; closed < 16; ++closed) {
        INFO("closed streams: " << closed);
        CHECK(codeOfChild([&] {
                  for (int stream = 0; stream < 4; ++stream)
                      if ((closed & (1 << stream)) != 0) ::close(stream);
                  const auto end = runConfined({"/bin/sh", "-c", script}, {});
                  if (!end) return 1;
                  return end.value().output == "result" && end.value().printed == "chatter\n" ? 0 : 2;
              }) == 0);
    }
}

TEST_CASE("a program that isn't there can't be started") {
    const auto end = runConfined({"/no/such/program"}, {});
    REQUIRE_FALSE(end);
    CHECK(end.error().location == "/no/such/program");
}

TEST_CASE("a confined process reads files and can do nothing else to the world") {
    const test::ScratchFolder folder;
    std::ofstream(folder / "old") << "old";
    const std::string old = folder / "old";
    const std::string fresh = folder / "new";
    const int failed = codeOfChild([&] {
        if (!forbidSideEffects()) return 100;
        int wrong = 0;
        wrong += ::open(old.c_str(), O_RDONLY) < 0 ? 1 : 0;
        wrong += ::open(old.c_str(), O_WRONLY) >= 0 ? 1 : 0;
        wrong += ::open(old.c_str(), O_RDONLY | O_TRUNC) >= 0 ? 1 : 0;
        wrong += ::open(fresh.c_str(), O_RDWR | O_CREAT, 0600) >= 0 ? 1 : 0;
        wrong += ::unlink(old.c_str()) == 0 ? 1 : 0;
        wrong += ::rename(old.c_str(), fresh.c_str()) == 0 ? 1 : 0;
        wrong += ::socket(AF_INET, SOCK_STREAM, 0) >= 0 ? 1 : 0;
        wrong += ::fork() >= 0 ? 1 : 0;
        ::execl("/bin/true", "true", nullptr);
        return wrong;
    });
    if (failed == 100) return;  // no filter on this system
    CHECK(failed == 0);
    CHECK(test::fileText(old) == "old");
}

TEST_CASE("a confined process gets no more memory than it may, and is ended when it takes too long") {
    ProcessLimits limits;
    limits.memoryBytes = std::size_t{512} << 20U;
    limits.seconds = 1;
    const int memory = codeOfChild([&] {
        confineThisProcess(limits);
        const std::vector<char>* big = nullptr;
        try {
            big = new std::vector<char>(std::size_t{1} << 30U);
        } catch (const std::bad_alloc&) {
            return 5;
        }
        return big->empty() ? 1 : 2;
    });
#if !defined(__SANITIZE_ADDRESS__)
    CHECK(memory == 5);
#else
    static_cast<void>(memory);
#endif
    const int time = codeOfChild([&] {
        confineThisProcess(limits);
        volatile unsigned turns = 0;  // volatile: a loop without an effect may be taken away
        while (true) {
            const unsigned next = turns + 1;
            turns = next;
        }
        return 0;
    });
    CHECK(time == 128 + SIGXCPU);
}
