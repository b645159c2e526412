#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "core/files.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using lutka::test::filesIn;
namespace fs = std::filesystem;

TEST_CASE("a file is written whole, with its missing folders") {
    const test::ScratchFolder folder;
    const fs::path file = folder.path / "a" / "b.txt";
    REQUIRE(writeFileAtomically(file, "hello"));
    CHECK(test::fileText(file) == "hello");
    REQUIRE(writeFileAtomically(file, "again"));
    CHECK(test::fileText(file) == "again");
    CHECK(filesIn(file.parent_path()) == 1);
}

TEST_CASE("a writer that fails leaves the old file and nothing beside it") {
    const test::ScratchFolder folder;
    const fs::path file = folder.path / "kept.txt";
    REQUIRE(writeFileAtomically(file, "old"));
    const auto result = writeFileAtomically(file, [](const fs::path& temporary) -> Result<void> {
        std::ofstream(temporary) << "half";
        return Error{ErrorCode::output, "the encoder broke", temporary.string(), ""};
    });
    REQUIRE_FALSE(result);
    CHECK(result.error().location == file.string());
    CHECK(test::fileText(file) == "old");
    CHECK(filesIn(folder.path) == 1);
}

TEST_CASE("a full disk is an output error that names the file") {
    if (!fs::exists("/dev/full")) SKIP_TEST("this system has no /dev/full");
    const auto result = writeFileAtomically("/dev/full/x", "data");
    REQUIRE_FALSE(result);
    CHECK(result.error().code == ErrorCode::output);
    CHECK(result.error().text().find("/dev/full/x") != std::string::npos);
}

TEST_CASE("reading a missing file, a folder or a file above the cap is an input error") {
    const test::ScratchFolder folder;
    const auto missing = readFile(folder.path / "nothing");
    REQUIRE_FALSE(missing);
    CHECK(missing.error().code == ErrorCode::input);
    CHECK(missing.error().text().find("nothing") != std::string::npos);
    CHECK_FALSE(readFile(folder.path));
    REQUIRE(writeFileAtomically(folder.path / "big", "0123456789"));
    CHECK_FALSE(readFile(folder.path / "big", 9));
    const auto whole = readFile(folder.path / "big", 10);
    REQUIRE(whole);
    CHECK(whole.value().size() == 10);
}

TEST_CASE("a missing asset names where it was looked for and the mend") {
    const auto found = findAsset("no/such/asset");
    REQUIRE_FALSE(found);
    CHECK(found.error().code == ErrorCode::input);
    CHECK(found.error().mend.find("LUTKA_ASSETS") != std::string::npos);
}

TEST_CASE("a link stays a link and its target is written") {
    const test::ScratchFolder folder;
    REQUIRE(writeFileAtomically(folder.path / "target", "old"));
    fs::create_symlink(folder.path / "target", folder.path / "link");
    REQUIRE(writeFileAtomically(folder.path / "link", "new"));
    CHECK(fs::is_symlink(folder.path / "link"));
    CHECK(test::fileText(folder.path / "target") == "new");
}

TEST_CASE("a link whose target is not there yet stays a link, and one in a circle is an output error that names it") {
    const test::ScratchFolder folder;
    fs::create_symlink("below/target", folder.path / "link");
    REQUIRE(writeFileAtomically(folder.path / "link", "new"));
    CHECK(fs::is_symlink(folder.path / "link"));
    CHECK(test::fileText(folder.path / "below" / "target") == "new");
    fs::create_symlink("circle", folder.path / "circle");
    const auto circle = writeFileAtomically(folder.path / "circle", "lost");
    REQUIRE_FALSE(circle);
    CHECK(circle.error().code == ErrorCode::output);
    CHECK(circle.error().location == (folder.path / "circle").string());
    CHECK(fs::is_symlink(folder.path / "circle"));
}

TEST_CASE("a file that only its owner may read stays so when it is written anew") {
    const test::ScratchFolder folder;
    const fs::path file = folder.path / "own.txt";
    REQUIRE(writeFileAtomically(file, "old"));
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    REQUIRE(writeFileAtomically(file, "new"));
    CHECK(test::fileText(file) == "new");
    CHECK(fs::status(file).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("a pipe is written straight by bytes and refused where a second version is needed") {
    const test::ScratchFolder folder;
    const fs::path pipe = folder.path / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const auto refused = writeFileAtomically(pipe, [](const fs::path&) -> Result<void> { return {}; });
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == ErrorCode::output);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    REQUIRE(writeFileAtomically(pipe, "streamed"));
    char read[16] = {};
    CHECK(::read(reader, read, sizeof read) == 8);
    CHECK(std::string(read) == "streamed");
    ::close(reader);
    CHECK(fs::is_fifo(pipe));
}
