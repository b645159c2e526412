#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "editor/input/input_event.hpp"

namespace lutka::editor {

/// Events with the frame at which they arrive. The file is JSON lines (docs/editor.md): a header
/// {"format": "lutka.input", "version": 1, "size": [w, h]}, then one event a line, frames never going back.
struct InputScript {
    static constexpr int kVersion = 1;
    static constexpr int kMaxFrame = 1'000'000;  ///< More is refused: hours of frames, surely a mistake.

    struct Entry {
        int frame = 0;  ///< Counted from 0; a frame lasts 1/60 s whatever the clock says.
        InputEvent event;

        friend bool operator==(const Entry&, const Entry&) = default;
    };

    render::Extent size{1280, 720};  ///< The window at frame 0.
    std::vector<Entry> entries;

    /// The last frame with an event; -1 when there is none.
    [[nodiscard]] int lastFrame() const { return entries.empty() ? -1 : entries.back().frame; }
};

[[nodiscard]] std::string scriptToText(const InputScript& script);

/// Fails with ErrorCode::input, naming the line, for anything that is not such a file. `source` names it in messages.
[[nodiscard]] Result<InputScript> scriptFromText(std::string_view text, std::string_view source);

[[nodiscard]] Result<void> saveScript(const std::filesystem::path& file, const InputScript& script);
[[nodiscard]] Result<InputScript> loadScript(const std::filesystem::path& file);

/// Writes a script event by event, so that what the user did is on disk even when the program does not end well.
class ScriptWriter {
  public:
    /// Writes the header, to standard output where the file is one of its names (isStandardOutput()). Fails with
    /// ErrorCode::output when it can't be written.
    [[nodiscard]] static Result<ScriptWriter> create(const std::filesystem::path& file, render::Extent size);
    /// Appends the events of a frame. Fails with ErrorCode::output.
    [[nodiscard]] Result<void> add(std::span<const InputScript::Entry> entries);

  private:
    ScriptWriter(std::filesystem::path file, std::ofstream stream)
        : file_(std::move(file)), stream_(std::move(stream)) {}
    [[nodiscard]] Result<void> write(const std::string& text);

    std::filesystem::path file_;
    std::ofstream stream_;
};

/// Hands out a script's events frame by frame.
class ScriptPlayer {
  public:
    explicit ScriptPlayer(InputScript script) : script_(std::move(script)) {}

    /// The events of `frame` and of earlier frames that were not asked for; valid while the player lives.
    [[nodiscard]] std::span<const InputScript::Entry> take(int frame);
    [[nodiscard]] bool finished() const { return next_ == script_.entries.size(); }
    [[nodiscard]] const InputScript& script() const { return script_; }

  private:
    InputScript script_;
    std::size_t next_ = 0;
};

}  // namespace lutka::editor
