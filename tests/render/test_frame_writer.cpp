#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/files.hpp"
#include "render/child_process.hpp"
#include "render/frame_writer.hpp"
#include "support/catch.hpp"
#include "support/skip.hpp"

using namespace lutka;
using namespace lutka::render;

namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, gone afterwards.
class Folder {
  public:
    explicit Folder(const std::string& name)
        : path_(fs::temp_directory_path() / ("lutka-frames-" + std::to_string(::getpid()) + "-" + name)) {
        fs::create_directories(path_);
    }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    [[nodiscard]] fs::path operator/(const std::string& name) const { return path_ / name; }
    [[nodiscard]] int fileCount() const {
        return static_cast<int>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
    }

  private:
    fs::path path_;
};

Image frameOf(Extent size, int number) {
    return {size, {static_cast<std::uint8_t>(20 * number), 90, 160, 255}};
}

std::string firstBytes(const fs::path& file) {
    const auto bytes = readFile(file);
    REQUIRE(bytes.ok());
    REQUIRE(bytes.value().size() > 12);
    return {bytes.value().begin(), bytes.value().begin() + 12};
}

}  // namespace

TEST_CASE("a PNG sequence counts its frames from 0000") {
    const Folder folder("png");
    Result<FrameWriter> writer = FrameWriter::open(folder / "fall.png", {8, 6}, 30);
    REQUIRE(writer.ok());
    for (int i = 0; i < 3; ++i)
        REQUIRE(writer.value().add(frameOf({8, 6}, i)).ok());
    REQUIRE(writer.value().finish().ok());
    CHECK(writer.value().frameCount() == 3);
    CHECK(folder.fileCount() == 3);
    const Result<Image> last = loadPng(folder / "fall_0002.png");
    REQUIRE(last.ok());
    CHECK(last.value().at(0, 0).r == 40);
}

TEST_CASE("an mp4 with odd sides is written whole and alone") {
    if (!FrameWriter::ffmpegIsThere()) SKIP_TEST("the program ffmpeg is not on the PATH");
    const Folder folder("mp4");
    Result<FrameWriter> writer = FrameWriter::open(folder / "fall.mp4", {65, 33}, 30);
    REQUIRE(writer.ok());
    for (int i = 0; i < 10; ++i)
        REQUIRE(writer.value().add(frameOf({65, 33}, i)).ok());
    CHECK_FALSE(fs::exists(folder / "fall.mp4"));
    REQUIRE(writer.value().finish().ok());
    CHECK(folder.fileCount() == 1);
    CHECK(firstBytes(folder / "fall.mp4").substr(4, 4) == "ftyp");
}

TEST_CASE("a gif is written whole and alone") {
    if (!FrameWriter::ffmpegIsThere()) SKIP_TEST("the program ffmpeg is not on the PATH");
    const Folder folder("gif");
    Result<FrameWriter> writer = FrameWriter::open(folder / "fall.gif", {64, 32}, 25);
    REQUIRE(writer.ok());
    for (int i = 0; i < 5; ++i)
        REQUIRE(writer.value().add(frameOf({64, 32}, i)).ok());
    REQUIRE(writer.value().finish().ok());
    CHECK(folder.fileCount() == 1);
    CHECK(firstBytes(folder / "fall.gif").substr(0, 6) == "GIF89a");
}

TEST_CASE("a film that is written through a link leaves the link, and links in a circle are refused at the start") {
    if (!FrameWriter::ffmpegIsThere()) SKIP_TEST("the program ffmpeg is not on the PATH");
    const Folder folder("link");
    fs::create_symlink("below/film.mp4", folder / "link.mp4");
    Result<FrameWriter> writer = FrameWriter::open(folder / "link.mp4", {64, 32}, 30);
    REQUIRE(writer.ok());
    REQUIRE(writer.value().add(frameOf({64, 32}, 1)).ok());
    REQUIRE(writer.value().finish().ok());
    CHECK(fs::is_symlink(folder / "link.mp4"));
    CHECK(firstBytes(folder / "below/film.mp4").substr(4, 4) == "ftyp");
    fs::create_symlink("circle.gif", folder / "circle.gif");
    const Result<FrameWriter> circle = FrameWriter::open(folder / "circle.gif", {64, 32}, 25);
    REQUIRE_FALSE(circle.ok());
    CHECK(circle.error().code == ErrorCode::output);
}

TEST_CASE("a video that is dropped before its end leaves nothing behind and keeps the old file") {
    if (!FrameWriter::ffmpegIsThere()) SKIP_TEST("the program ffmpeg is not on the PATH");
    const Folder folder("dropped");
    std::ofstream(folder / "fall.mp4") << "an old film";
    {
        Result<FrameWriter> writer = FrameWriter::open(folder / "fall.mp4", {64, 32}, 30);
        REQUIRE(writer.ok());
        REQUIRE(writer.value().add(frameOf({64, 32}, 1)).ok());
    }
    CHECK(folder.fileCount() == 1);
    CHECK(fs::file_size(folder / "fall.mp4") == 11);
}

TEST_CASE("an extension that is no film is refused before anything is written") {
    const Folder folder("words");
    const Result<FrameWriter> writer = FrameWriter::open(folder / "fall.avi", {8, 8}, 30);
    REQUIRE_FALSE(writer.ok());
    CHECK(writer.error().code == ErrorCode::usage);
    CHECK(folder.fileCount() == 0);
}

TEST_CASE("a missing program is told apart from a failing one") {
    CHECK_FALSE(ChildProcess::isOnPath("no-such-program-of-ours"));
    CHECK_FALSE(ChildProcess::start({"no-such-program-of-ours"}).ok());
    Result<ChildProcess> failing = ChildProcess::start({"sh", "-c", "echo out of paint >&2; exit 3"});
    REQUIRE(failing.ok());
    const ChildProcess::Ended ended = failing.value().finish();
    CHECK_FALSE(ended.succeeded);
    CHECK(ended.errorText == "out of paint");
}

TEST_CASE("writing to a program that has gone fails instead of ending us") {
    Result<ChildProcess> gone = ChildProcess::start({"true"});
    REQUIRE(gone.ok());
    const std::vector<std::uint8_t> much(std::size_t{4} << 20U, 7);
    CHECK_FALSE(gone.value().write(much));
    CHECK(gone.value().finish().succeeded);
}

TEST_CASE("a program whose end nobody could wait for has not succeeded") {
    const auto before = ::signal(SIGCHLD, SIG_IGN);
    Result<ChildProcess> program = ChildProcess::start({"false"});
    REQUIRE(program.ok());
    const ChildProcess::Ended ended = program.value().finish();
    ::signal(SIGCHLD, before);
    CHECK_FALSE(ended.succeeded);
}
