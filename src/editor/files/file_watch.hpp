#pragma once

#include <filesystem>
#include <optional>

namespace lutka::editor {

/// Tells when a file was written by somebody else. It asks the file system now and then, and waits until the file has
/// been left alone for a moment: half a file is none.
class FileWatch {
  public:
    /// Of this file as it is now. Empty: nothing is watched.
    void watch(const std::filesystem::path& file);
    /// `seconds` have passed; whether the file is another one since it was watched, or since this was told last.
    [[nodiscard]] bool changed(double seconds);

    static constexpr double kEverySeconds = 0.5;

  private:
    struct Seen {
        std::filesystem::file_time_type time;
        std::uintmax_t bytes = 0;
        friend bool operator==(const Seen&, const Seen&) = default;
    };
    [[nodiscard]] std::optional<Seen> look() const;

    std::filesystem::path file_;
    std::optional<Seen> known_;
    std::optional<Seen> last_;  // at the last look
    double waited_ = 0.0;
};

}  // namespace lutka::editor
