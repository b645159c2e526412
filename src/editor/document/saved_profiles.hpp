#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lutka::editor {

/// What was loaded or saved last, one entry for each profile that the document was based on. A base is named by the
/// file it was read from; an empty name is the fit. It also knows the session's own files: those that it opened or
/// wrote.
class SavedProfiles {
  public:
    /// The fit as it was made: nothing is on disk yet.
    void begin(std::string json) { saved_[{}] = {{}, std::move(json)}; }
    /// The profile on that base was read from `file`, or written there.
    void remember(const std::filesystem::path& base, const std::filesystem::path& file, std::string json);
    /// The file of the profile on that base, when it has one.
    [[nodiscard]] std::optional<std::filesystem::path> fileOf(const std::filesystem::path& base) const;
    /// Whether `json` is something else than what was loaded or saved last on that base.
    [[nodiscard]] bool differs(const std::filesystem::path& base, const std::string& json) const;
    /// Whether `file` is there and not the session's own.
    [[nodiscard]] bool wouldReplace(const std::filesystem::path& file) const;

  private:
    struct Saved {
        std::filesystem::path file;
        std::string json;
    };
    std::map<std::filesystem::path, Saved> saved_;
    std::vector<std::filesystem::path> own_;
};

}  // namespace lutka::editor
