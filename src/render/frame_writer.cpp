#include "render/frame_writer.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <vector>

#include "core/assert.hpp"
#include "render/child_process.hpp"

namespace lutka::render {
namespace {

namespace fs = std::filesystem;

enum class Format { mp4, gif, pngs };

std::optional<Format> formatOf(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".mp4") return Format::mp4;
    if (extension == ".gif") return Format::gif;
    if (extension == ".png") return Format::pngs;
    return std::nullopt;
}

// Without the protocol a colon in a name would be taken for one.
std::string ffmpegName(const fs::path& file) {
    return "file:" + file.string();
}

// Beside the target, so that the last rename stays on one file system.
fs::path temporaryBeside(const fs::path& file, const std::string& extension) {
    fs::path temporary = file;
    // Not the file's own stem: ffmpeg reads a % in it as a pattern.
    temporary.replace_filename(fmt::format(".lutka.{}{}", ::getpid(), extension));
    return temporary;
}

std::vector<std::string> inputArguments(Extent size, double framesPerSecond) {
    return {"ffmpeg",
            "-hide_banner",
            "-loglevel",
            "error",
            "-y",
            "-f",
            "rawvideo",
            "-pix_fmt",
            "rgba",
            "-s",
            fmt::format("{}x{}", size.width, size.height),
            "-r",
            fmt::format("{}", framesPerSecond),
            "-i",
            "pipe:0"};
}

}  // namespace

struct FrameWriter::State {
    fs::path file;
    fs::path temporary;  ///< What ffmpeg writes; empty for PNG sequences.
    Format format = Format::pngs;
    Extent size;
    int frames = 0;
    std::optional<ChildProcess> encoder;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        encoder.reset();
        std::error_code ignored;
        if (!temporary.empty()) fs::remove(temporary, ignored);
    }

    [[nodiscard]] Error encoderError(const std::string& words) const {
        return {ErrorCode::output, words.empty() ? "ffmpeg stopped without a word" : "ffmpeg failed: " + words,
                file.string(), "check the free space of the disk, or write PNG frames (-o NAME.png)"};
    }

    Result<void> startEncoder(double framesPerSecond) {
        std::vector<std::string> arguments = inputArguments(size, framesPerSecond);
        const auto append = [&](std::initializer_list<const char*> more) {
            arguments.insert(arguments.end(), more.begin(), more.end());
        };
        if (format == Format::mp4) {
            temporary = temporaryBeside(file, ".mp4");
            // yuv420p halves the chroma: both sides must be even.
            append({"-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2:0:0", "-c:v", "libx264", "-preset", "veryfast", "-crf",
                    "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart"});
        } else {
            // Lossless first: the palette must have seen the whole clip, and ffmpeg would hold all of it in memory.
            temporary = temporaryBeside(file, ".mkv");
            append({"-c:v", "ffv1", "-pix_fmt", "bgr0"});
        }
        arguments.push_back(ffmpegName(temporary));
        Result<ChildProcess> started = ChildProcess::start(arguments);
        if (!started) return started.error();
        encoder.emplace(std::move(started).value());
        return {};
    }

    Result<void> finishEncoder() {
        const ChildProcess::Ended ended = encoder->finish();
        encoder.reset();
        if (!ended.succeeded) return encoderError(ended.errorText);
        return {};
    }

    Result<void> runToEnd(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"ffmpeg", "-hide_banner", "-loglevel", "error", "-y"});
        Result<ChildProcess> started = ChildProcess::start(arguments);
        if (!started) return started.error();
        const ChildProcess::Ended ended = started.value().finish();
        if (!ended.succeeded) return encoderError(ended.errorText);
        return {};
    }

    // Two passes over the lossless file: the palette of all frames, then the frames in it.
    Result<void> makeGif() {
        const fs::path palette = temporaryBeside(file, ".png");
        const fs::path gif = temporaryBeside(file, ".gif");
        Result<void> result = runToEnd({"-i", ffmpegName(temporary), "-vf", "palettegen=stats_mode=diff", "-update",
                                        "1", "-frames:v", "1", ffmpegName(palette)});
        if (result) {
            result = runToEnd({"-i", ffmpegName(temporary), "-i", ffmpegName(palette), "-lavfi",
                               "paletteuse=dither=bayer:bayer_scale=4:diff_mode=rectangle", ffmpegName(gif)});
        }
        std::error_code ignored;
        fs::remove(palette, ignored);
        fs::remove(temporary, ignored);
        temporary = gif;
        return result;
    }
};

FrameWriter::FrameWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
FrameWriter::FrameWriter(FrameWriter&&) noexcept = default;
FrameWriter& FrameWriter::operator=(FrameWriter&&) noexcept = default;
FrameWriter::~FrameWriter() = default;

bool FrameWriter::isVideo(const fs::path& file) {
    const std::optional<Format> format = formatOf(file);
    return format == Format::mp4 || format == Format::gif;
}

bool FrameWriter::ffmpegIsThere() {
    return ChildProcess::isOnPath("ffmpeg");
}

Result<FrameWriter> FrameWriter::open(const fs::path& file, Extent size, double framesPerSecond) {
    LUTKA_ASSERT(size.width > 0 && size.height > 0 && framesPerSecond >= 1.0 && framesPerSecond <= 1000.0);
    const std::optional<Format> format = formatOf(file);
    if (!format) {
        return Error{ErrorCode::usage, "is neither .mp4, .gif nor .png", file.string(),
                     "give the output one of these extensions"};
    }
    auto state = std::make_unique<State>();
    state->file = file;
    state->format = *format;
    state->size = size;
    std::error_code failed;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), failed);
    if (failed) {
        return Error{ErrorCode::output, "its folder can't be made: " + failed.message(), file.string(),
                     "check that the folder is writable"};
    }
    if (*format == Format::pngs) return FrameWriter(std::move(state));
    if (!ffmpegIsThere()) {
        return Error{ErrorCode::output, "the program ffmpeg, which encodes videos, is not on the PATH", file.string(),
                     "install ffmpeg, or write PNG frames (-o NAME.png)"};
    }
    const Result<void> started = state->startEncoder(framesPerSecond);
    if (!started) return started.error();
    return FrameWriter(std::move(state));
}

Result<void> FrameWriter::add(const Image& frame) {
    LUTKA_ASSERT(frame.size() == state_->size);
    const int number = state_->frames++;
    if (state_->format == Format::pngs) {
        fs::path file = state_->file;
        file.replace_filename(fmt::format("{}_{:04d}.png", file.stem().string(), number));
        return savePng(frame, file);
    }
    LUTKA_ASSERT(state_->encoder.has_value());
    if (state_->encoder->write(frame.rgba)) return {};
    const Result<void> ended = state_->finishEncoder();
    return ended ? Result<void>(state_->encoderError("it stopped reading")) : ended;
}

Result<void> FrameWriter::finish() {
    LUTKA_ASSERT(state_->frames > 0);
    if (state_->format == Format::pngs) return {};
    LUTKA_ASSERT(state_->encoder.has_value());
    Result<void> result = state_->finishEncoder();
    if (result && state_->format == Format::gif) result = state_->makeGif();
    if (!result) return result;
    std::error_code failed;
    fs::rename(state_->temporary, state_->file, failed);
    if (failed) {
        return Error{ErrorCode::output, "can't be written: " + failed.message(), state_->file.string(),
                     "check that the folder is writable"};
    }
    state_->temporary.clear();
    return {};
}

int FrameWriter::frameCount() const {
    return state_->frames;
}

}  // namespace lutka::render
