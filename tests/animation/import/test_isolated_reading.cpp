#include <sys/stat.h>

#include "animation/import/isolated_reading.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::animation::rig_import;

namespace {

Isolation smallIsolation() {
    Isolation isolation;
    isolation.program = LUTKA_READING_WORKER;
    isolation.limits.memoryBytes = std::size_t{512} << 20U;
    isolation.limits.seconds = 2;
    return isolation;
}

Result<SourceScene> readText(const test::ScratchFolder& folder, const std::string& text,
                             const Isolation& isolation = smallIsolation()) {
    const std::string file = folder / "model.glb";
    std::ofstream(file) << text;
    return readIsolated(file, {}, isolation);
}

std::string refusalOfBlob(const std::string& text) {
    const test::ScratchFolder folder;
    const auto read = readText(folder, text);
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
    CHECK(readText(folder, "print"));
}

TEST_CASE("a reader that crashes, hangs, overflows its stack or eats memory is an error that says so") {
    CHECK_THAT(refusalOfBlob("crash"), Catch::Contains("signal 11"));
    CHECK_THAT(refusalOfBlob("hang"), Catch::Contains("more than 2 seconds"));
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
