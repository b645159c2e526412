#include <sys/stat.h>

#include <string>
#include <vector>

#include "animation/import/isolated_reading.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/other_streams.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::animation::rig_import;

namespace {

// Time for a busy machine: all but a file that hangs end long before.
Isolation smallIsolation(int seconds = 120) {
    Isolation isolation;
    isolation.program = LUTKA_READING_WORKER;
    isolation.limits.memoryBytes = std::size_t{512} << 20U;
    isolation.limits.seconds = seconds;
    return isolation;
}

Result<SourceScene> readText(const test::ScratchFolder& folder, const std::string& text,
                             const Isolation& isolation = smallIsolation()) {
    const std::string file = folder / "model.glb";
    std::ofstream(file) << text;
    return readIsolated(file, {}, isolation);
}

std::string refusalOfBlob(const std::string& text, const Isolation& isolation = smallIsolation()) {
    const test::ScratchFolder folder;
    const auto read = readText(folder, text, isolation);
    REQUIRE_FALSE(read);
    CHECK(read.error().code == ErrorCode::input);
    CHECK_THAT(read.error().location, Catch::Contains("model.glb"));
    return read.error().message;
}

}  // namespace

TEST_CASE("a scene read by another process is the scene") {
    const test::ScratchFolder folder;
    const auto read = readText(folder, "good");
    REQUIRE(read);
    CHECK(read.value().format == "with pictures");
    CHECK(read.value().nodes.at(0).name == "root");
    ImportOptions without;
    without.loadTextures = false;
    const auto bare = readIsolated(folder / "model.glb", without, smallIsolation());
    REQUIRE(bare);
    CHECK(bare.value().format == "without pictures");
}

TEST_CASE("what readers print is told line by line, fit for a terminal, and is no matter of our own streams") {
    const test::ScratchFolder folder;
    std::vector<std::string> lines;
    Isolation isolation = smallIsolation();
    isolation.printed = [&](const std::string& line) { lines.push_back(line); };
    const std::vector<std::string> told = {"in  [31mcolour?  31m", "a third party's chatter"};
    // The reading process may write no file: where ours is one it must not print there.
    for (const char* stream : {"", "/dev/full", "a file"}) {
        INFO("standard output and error: " << (*stream == '\0' ? "closed" : stream));
        lines.clear();
        bool read = false;
        bool crashed = false;
        {
            const test::OtherStreams streams(stream == std::string("a file") ? folder / "log" : stream);
            read = readText(folder, "print", isolation).ok();
            const auto refused = readText(folder, "print and crash", isolation);
            crashed = !refused && refused.error().message.find("signal 11") != std::string::npos;
        }
        CHECK(read);
        CHECK(crashed);
        REQUIRE(lines.size() == 4);
        CHECK_THAT(std::vector<std::string>(lines.begin(), lines.begin() + 2), Catch::UnorderedEquals(told));
        CHECK_THAT(std::vector<std::string>(lines.begin() + 2, lines.end()), Catch::UnorderedEquals(told));
    }
}

TEST_CASE("without a log, what readers print goes to standard error") {
    const test::ScratchFolder folder;
    {
        const test::OtherStreams streams(folder / "log");
        static_cast<void>(readText(folder, "print"));
    }
    CHECK_THAT(test::fileText(folder / "log"), Catch::Contains("a third party's chatter\n"));
}

TEST_CASE("a reader that crashes, hangs, overflows its stack or eats memory is an error that says so") {
    CHECK_THAT(refusalOfBlob("crash"), Catch::Contains("signal 11"));
    CHECK_THAT(refusalOfBlob("hang", smallIsolation(2)), Catch::Contains("more than 2 seconds"));
    CHECK_THAT(refusalOfBlob("deep"), Catch::Contains("signal 11"));
#if !defined(__SANITIZE_ADDRESS__)
    CHECK_THAT(refusalOfBlob("bomb"), Catch::Contains("more than 512 MiB"));
#endif
}

TEST_CASE("what a reader throws or refuses comes through, and a scene that makes no sense doesn't") {
    CHECK(refusalOfBlob("throw") == "can't be imported: thrown");
    CHECK(refusalOfBlob("error") == "is not to my taste");
    CHECK_THAT(refusalOfBlob("wrong"), Catch::Contains("no sound scene"));
}

TEST_CASE("a reader writes no files") {
    const test::ScratchFolder folder;
    const auto read = readText(folder, "write");
    REQUIRE(read);
    CHECK(read.value().format == "with pictures");
}

TEST_CASE("a reading that is stopped ends at once") {
    const test::ScratchFolder folder;
    Isolation isolation = smallIsolation();
    isolation.limits.seconds = 600;
    isolation.stop = [] { return true; };
    const auto read = readText(folder, "hang", isolation);
    REQUIRE_FALSE(read);
    CHECK(read.error().message == "reading was stopped");
}

TEST_CASE("only ordinary files are given to the reading process") {
    const test::ScratchFolder folder;
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    for (const char* name : {"pipe", "missing", "."}) {
        INFO(name);
        const auto read = readIsolated(folder / name, {}, smallIsolation());
        REQUIRE_FALSE(read);
        CHECK(read.error().code == ErrorCode::input);
    }
}
