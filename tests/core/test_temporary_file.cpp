#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <set>
#include <string>

#include "core/files.hpp"
#include "core/temporary_file.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using lutka::test::filesIn;
namespace fs = std::filesystem;

namespace {

// What a process leaves that is killed between writing and renaming.
void leaveBehind(const fs::path& target) {
    const pid_t child = ::fork();
    if (child == 0) {
        const auto file = TemporaryFile::beside(target, ".txt");
        if (file) ::raise(SIGKILL);
        ::_exit(1);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
}

}  // namespace

TEST_CASE("two temporary files of one target are two files, and both go when they are dropped") {
    const test::ScratchFolder folder;
    {
        const auto first = TemporaryFile::beside(folder.path / "a.txt", ".txt");
        const auto second = TemporaryFile::beside(folder.path / "a.txt", ".txt");
        REQUIRE(first);
        REQUIRE(second);
        CHECK(first.value().path() != second.value().path());
        CHECK(first.value().path().extension() == ".txt");
        CHECK(filesIn(folder.path) == 2);
    }
    CHECK(filesIn(folder.path) == 0);
}

TEST_CASE("a process that a signal ends takes its temporary files along, and what it replaced stays") {
    const test::ScratchFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        const auto first = TemporaryFile::beside(folder.path / "a.txt", ".txt");
        const auto second = TemporaryFile::beside(folder.path / "b.txt", ".txt");
        { const auto dropped = TemporaryFile::beside(folder.path / "c.txt", ".txt"); }
        if (!writeFileAtomically(folder.path / "whole.txt", "whole")) ::_exit(1);
        std::signal(SIGALRM, [](int) {
            removeTemporaryFiles();
            ::_exit(7);
        });
        ::raise(SIGALRM);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 7);
    CHECK(filesIn(folder.path) == 1);
    CHECK(test::fileText(folder / "whole.txt") == "whole");
}

TEST_CASE("many more files than a signal handler knows are written one after the other") {
    const test::ScratchFolder folder;
    for (int i = 0; i < 100; ++i)
        REQUIRE(writeFileAtomically(folder.path / ("file" + std::to_string(i)), "whole"));
    CHECK(filesIn(folder.path) == 100);
}

// Two containers that share a folder may run under the same number: a handler that removes what it noted must not meet
// the other's file.
TEST_CASE("nobody can foresee the name of a temporary file, who knows the process's number neither") {
    const test::ScratchFolder folder;
    std::set<fs::path> names;
    for (int i = 0; i < 20; ++i) {
        const auto file = TemporaryFile::beside(folder.path / "a.txt", ".txt");
        REQUIRE(file);
        CHECK(file.value().path().filename().string().find(std::to_string(::getpid()) + "-") == std::string::npos);
        names.insert(file.value().path());
    }
    CHECK(names.size() == 20);
}

TEST_CASE("what a killed process left behind is removed by the next one that writes there, and nothing else is") {
    const test::ScratchFolder folder;
    leaveBehind(folder.path / "a.txt");
    REQUIRE(filesIn(folder.path) == 1);
    const auto living = TemporaryFile::beside(folder.path / "b.txt", ".txt");
    REQUIRE(living);
    std::ofstream(folder / "lutka-notes.txt") << "the user's";
    REQUIRE(writeFileAtomically(folder.path / "c.txt", "new"));
    CHECK(fs::exists(living.value().path()));
    CHECK(fs::exists(folder / "lutka-notes.txt"));
    CHECK(filesIn(folder.path) == 3);
}

TEST_CASE("a name as long as the file system allows is written") {
    const test::ScratchFolder folder;
    const fs::path plain = folder.path / std::string(255, 'n');
    const fs::path extended = folder.path / ("n." + std::string(253, 'x'));
    CHECK(writeFileAtomically(plain, "plain"));
    CHECK(writeFileAtomically(extended, "extended"));
    CHECK(test::fileText(plain) == "plain");
    CHECK(filesIn(folder.path) == 2);
}

TEST_CASE("a name that is not UTF-8 is written") {
    const test::ScratchFolder folder;
    const fs::path file = folder.path / "caf\xe9.txt";
    REQUIRE(writeFileAtomically(file, "text"));
    CHECK(test::fileText(file) == "text");
}

TEST_CASE("only ordinary files are read, and a pipe that nobody writes to doesn't hold us") {
    const test::ScratchFolder folder;
    const fs::path pipe = folder.path / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    for (const fs::path& file : {pipe, fs::path("/dev/zero"), folder.path}) {
        INFO(file);
        const auto bytes = readFile(file);
        REQUIRE_FALSE(bytes);
        CHECK(bytes.error().code == ErrorCode::input);
    }
}
