#pragma once

#include <filesystem>
#include <memory>

#include "core/result.hpp"
#include "render/image.hpp"

namespace lutka::render {

/// Writes the frames of an animation to one output, chosen by the file's extension:
///   .mp4  H.264, yuv420p, fast start; an odd width or height loses its last column or row
///   .gif  one palette for the whole clip
///   .png  a sequence beside the given name: out/fall.png gives out/fall_0000.png, out/fall_0001.png …
/// Videos are encoded by the program `ffmpeg`, found on the PATH, under a temporary name beside `file`; only finish()
/// gives them their name, so that an interrupted run leaves nothing behind under it.
class FrameWriter {
  public:
    /// `framesPerSecond` in [1, 1000]. Fails with ErrorCode::usage for an extension that is none of the three, with
    /// ErrorCode::output when ffmpeg is missing or the folder can't be written.
    [[nodiscard]] static Result<FrameWriter> open(const std::filesystem::path& file, Extent size,
                                                  double framesPerSecond);

    /// Whether that extension needs ffmpeg (.mp4, .gif).
    [[nodiscard]] static bool isVideo(const std::filesystem::path& file);
    /// Whether ffmpeg is on the PATH.
    [[nodiscard]] static bool ffmpegIsThere();

    FrameWriter(FrameWriter&&) noexcept;
    FrameWriter& operator=(FrameWriter&&) noexcept;
    /// Without finish(): stops the encoder and removes its temporary file.
    ~FrameWriter();

    /// Appends a frame of the size given to open() (a caller's bug otherwise). ErrorCode::output on failure.
    [[nodiscard]] Result<void> add(const Image& frame);

    /// Waits for the encoder and gives the file its name; add() may not be called afterwards. At least one frame.
    [[nodiscard]] Result<void> finish();

    [[nodiscard]] int frameCount() const;

  private:
    struct State;
    explicit FrameWriter(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace lutka::render
