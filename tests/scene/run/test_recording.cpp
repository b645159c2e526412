#include "scene/run/recording.hpp"

#include <unistd.h>

#include <cmath>
#include <cstring>

#include "core/files.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::scene;
namespace fs = std::filesystem;

namespace {

Recording sample() {
    Recording recording;
    recording.model = "figure";
    recording.scene = "drop";
    recording.dolls = 2;
    recording.bodiesPerDoll = 3;
    recording.props = 1;
    for (int i = 0; i < 4 * 7; ++i) {
        recording.frames.push_back({quat(0, 1, 0, 0), vec3(static_cast<float>(i), 0.5F, -2)});
    }
    return recording;
}

fs::path temporaryFile() {
    return fs::temp_directory_path() / ("lutka_recording_" + std::to_string(::getpid()));
}

struct RemoveAtEnd {
    fs::path file;
    ~RemoveAtEnd() { fs::remove(file); }
};

}  // namespace

TEST_CASE("a recording comes back as it was") {
    const RemoveAtEnd file{temporaryFile()};
    const Recording written = sample();
    CHECK(written.steps() == 4);
    REQUIRE(saveRecording(file.file, written));
    const auto read = loadRecording(file.file);
    REQUIRE(read);
    CHECK(read.value().model == "figure");
    CHECK(read.value().scene == "drop");
    CHECK(read.value().dolls == 2);
    CHECK(read.value().bodiesPerDoll == 3);
    CHECK(read.value().props == 1);
    CHECK(read.value().figure == 0);
    REQUIRE(read.value().frames.size() == written.frames.size());
    for (std::size_t i = 0; i < written.frames.size(); ++i) {
        CHECK(read.value().frames[i].translation == written.frames[i].translation);
        CHECK(read.value().frames[i].rotation == written.frames[i].rotation);
    }
}

TEST_CASE("a recording tells which of a file's figures it is of") {
    const RemoveAtEnd file{temporaryFile()};
    Recording written = sample();
    written.figure = 2;
    REQUIRE(saveRecording(file.file, written));
    const auto read = loadRecording(file.file);
    REQUIRE(read);
    CHECK(read.value().figure == 2);
}

TEST_CASE("a damaged recording is an input error that says what is wrong") {
    const RemoveAtEnd file{temporaryFile()};
    REQUIRE(saveRecording(file.file, sample()));
    const auto bytes = readFile(file.file);
    REQUIRE(bytes);
    const std::string good(bytes.value().begin(), bytes.value().end());
    const auto refusal = [&](const std::string& content) {
        REQUIRE(writeFileAtomically(file.file, content));
        const auto read = loadRecording(file.file);
        REQUIRE_FALSE(read);
        CHECK(read.error().code == ErrorCode::input);
        return read.error().message;
    };
    CHECK(refusal(good.substr(0, good.size() - 5)) == "is cut short");
    CHECK(refusal(good.substr(0, good.find('\n') + 1)) == "is cut short");
    CHECK(refusal("hello\n") == "is not a recording of ours");
    CHECK(refusal("no newline") == "is not a recording of ours");
    std::string notFinite = good;
    const float nan = NAN;
    std::memcpy(notFinite.data() + notFinite.find('\n') + 1, &nan, sizeof nan);
    CHECK(refusal(notFinite) == "holds a frame that is not finite");
    const auto withFirst = [&](std::initializer_list<float> values) {
        std::string other = good;
        std::memcpy(other.data() + other.find('\n') + 1, values.begin(), values.size() * sizeof(float));
        return other;
    };
    CHECK(refusal(withFirst({0, 0, 0, 0})) == "holds a rotation that is none");
    CHECK(refusal(withFirst({0, 1e19F, 0, 0})) == "holds a rotation that is none");
    CHECK(refusal(withFirst({0, 1, 0, 0, 1, -3e38F, 1})) == "holds a body more than 1000000000 m away");
    CHECK(withFirst({1, 0, 0, 0, 0, 0.5F, -2}) == good);
    std::string tooMany = good;
    tooMany.replace(tooMany.find("\"dolls\":2"), 9, "\"dolls\":0");
    CHECK(refusal(tooMany) == "has a damaged first line: /dolls: expected a whole number in [1, 100000], got 0");
}

TEST_CASE("the first line of a recording is judged before the gigabytes that follow are read", "[limits]") {
    const RemoveAtEnd file{temporaryFile()};
    REQUIRE(saveRecording(file.file, sample()));
    std::string good = test::fileText(file.file);
    const auto refusal = [&](const std::string& start) {
        REQUIRE(writeFileAtomically(file.file, start));
        // A hole, which takes no room on the disk.
        fs::resize_file(file.file, std::uintmax_t{1} << 40U);
        const auto read = loadRecording(file.file);
        REQUIRE_FALSE(read);
        return read.error().message;
    };
    CHECK(refusal("hello") == "is not a recording of ours");
    CHECK(refusal("{}\n") == "is not a recording of ours");
    CHECK(refusal(good) == "is larger than 4294967296 bytes");
    good.replace(good.find("\"dolls\":2"), 9, "\"dolls\":0");
    CHECK_THAT(refusal(good), Catch::StartsWith("has a damaged first line"));
}

TEST_CASE("a recording that is longer than what is read at once comes back as it was") {
    const RemoveAtEnd file{temporaryFile()};
    Recording written = sample();
    while (written.frames.size() < 100000)
        written.frames.insert(written.frames.end(), 7,
                              {quat(1, 0, 0, 0), vec3(0, static_cast<float>(written.frames.size()), 0)});
    REQUIRE(saveRecording(file.file, written));
    const auto read = loadRecording(file.file);
    REQUIRE(read);
    REQUIRE(read.value().frames.size() == written.frames.size());
    bool same = true;
    for (std::size_t i = 0; i < written.frames.size(); ++i)
        same = same && read.value().frames[i].translation == written.frames[i].translation;
    CHECK(same);
}

TEST_CASE("a recording of a character with a name without end can be read again") {
    const RemoveAtEnd file{temporaryFile()};
    Recording written = sample();
    written.model = std::string(std::size_t{5} << 20U, 'x');
    REQUIRE(saveRecording(file.file, written));
    CHECK(loadRecording(file.file));
}
