#include "render/frame_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/assert.hpp"
#include "core/files.hpp"
#include "core/letter_case.hpp"
#include "core/temporary_file.hpp"
#include "render/child_process.hpp"
#include "render/video_end.hpp"

namespace lutka::render {
namespace {

namespace fs = std::filesystem;

enum class Format { mp4, gif, pngs };

std::optional<Format> formatOf(const fs::path& file) {
    const std::string extension = lowerCased(file.extension().string());
    if (extension == ".mp4") return Format::mp4;
    if (extension == ".gif") return Format::gif;
    if (extension == ".png") return Format::pngs;
    return std::nullopt;
}

// Without the protocol a colon in a name would be taken for one.
std::string ffmpegName(const fs::path& file) {
    return "file:" + file.string();
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
    std::optional<TemporaryFile> temporary;  ///< What ffmpeg writes; unset for PNG sequences.
    Format format = Format::pngs;
    Extent size;
    int frames = 0;
    std::optional<ChildProcess> encoder;  ///< After the file that it writes: it ends first.

    [[nodiscard]] Error encoderError(const std::string& words) const {
        return {ErrorCode::output, words.empty() ? "ffmpeg stopped without a word" : "ffmpeg failed: " + words,
                file.string(), "check the free space of the disk, or write PNG frames (-o NAME.png)"};
    }

    /// A new file for ffmpeg. Not by the output's own stem, in which ffmpeg reads a % as a pattern.
    Result<void> openTemporary(std::string_view extension) {
        Result<TemporaryFile> opened = TemporaryFile::beside(file, extension);
        if (!opened) return opened.error();
        temporary.emplace(std::move(opened).value());
        return {};
    }

    Result<void> startEncoder(double framesPerSecond) {
        std::vector<std::string> arguments = inputArguments(size, framesPerSecond);
        const auto append = [&](std::initializer_list<const char*> more) {
            arguments.insert(arguments.end(), more.begin(), more.end());
        };
        // Lossless first for a GIF: its palette must have seen the whole clip, and ffmpeg would hold all of it in
        // memory.
        Result<void> opened = openTemporary(format == Format::mp4 ? ".mp4" : ".mkv");
        if (!opened) return opened;
        if (format == Format::mp4) {
            // yuv420p halves the chroma: both sides must be even.
            append({"-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2:0:0", "-c:v", "libx264", "-preset", "veryfast", "-crf",
                    "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart"});
        } else {
            append({"-c:v", "ffv1", "-pix_fmt", "bgr0"});
        }
        arguments.push_back(ffmpegName(temporary->path()));
        Result<ChildProcess> started = ChildProcess::start(arguments);
        if (!started) return started.error();
        encoder.emplace(std::move(started).value());
        return {};
    }

    Result<void> finishEncoder() {
        const ChildProcess::Ended ended = encoder->finish();
        encoder.reset();
        // It ends with success on a full disk, too, when only the file's index doesn't fit any more; it says so,
        // though.
        if (!ended.succeeded || ended.errorText.find("No space left") != std::string::npos)
            return encoderError(ended.errorText);
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
        Result<TemporaryFile> palette = TemporaryFile::beside(file, ".png");
        if (!palette) return palette.error();
        Result<TemporaryFile> gif = TemporaryFile::beside(file, ".gif");
        if (!gif) return gif.error();
        const std::string clipName = ffmpegName(temporary->path());
        const std::string paletteName = ffmpegName(palette.value().path());
        Result<void> result = runToEnd(
            {"-i", clipName, "-vf", "palettegen=stats_mode=diff", "-update", "1", "-frames:v", "1", paletteName});
        if (result) {
            result =
                runToEnd({"-i", clipName, "-i", paletteName, "-lavfi",
                          "paletteuse=dither=bayer:bayer_scale=4:diff_mode=rectangle", ffmpegName(gif.value().path())});
        }
        temporary.reset();
        temporary.emplace(std::move(gif).value());
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

Result<FrameWriter> FrameWriter::open(const fs::path& named, Extent size, double framesPerSecond) {
    LUTKA_ASSERT(size.width > 0 && size.height > 0 && framesPerSecond >= 1.0 && framesPerSecond <= 1000.0);
    const std::optional<Format> format = formatOf(named);
    if (!format) {
        return Error{ErrorCode::usage, "is neither .mp4, .gif nor .png", named.string(),
                     "give the output one of these extensions"};
    }
    Result<fs::path> target = outputTarget(named);
    if (!target) return target.error();
    auto state = std::make_unique<State>();
    // Of a sequence no file has the name that was given.
    state->file = *format == Format::pngs ? named : std::move(target).value();
    const fs::path& file = state->file;
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
    if (!isWholeVideo(state_->temporary->path())) return state_->encoderError("the film has no end");
    result = state_->temporary->replace(state_->file);
    if (result) state_->temporary.reset();
    return result;
}

int FrameWriter::frameCount() const {
    return state_->frames;
}

}  // namespace lutka::render
