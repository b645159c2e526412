#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace lutka::animation::rig_import {

/// Which files beside itself a model may have opened: ordinary ones in its folder and below. A model from the internet
/// has no business with others, and what it says of them (`../`, an absolute path, a link that leads away) is no wish
/// of the user's. Decided before anything is opened, with every link followed.
class ModelFolder {
  public:
    /// With `allowOutside` any ordinary file may be opened.
    ModelFolder(const std::filesystem::path& model, bool allowOutside);

    [[nodiscard]] const std::filesystem::path& path() const { return folder_; }  ///< As the model's path was given.
    [[nodiscard]] bool allowsOutside() const { return allowOutside_; }

    /// Whether a file or folder may be looked into: where it is once links are followed counts, not its name.
    [[nodiscard]] bool admits(const std::filesystem::path& place) const;

    enum class Place { inside, missing, outside };
    struct Named {
        Place place = Place::missing;
        std::filesystem::path file;  ///< To be opened, when it is `inside`.
    };
    /// The file that a name in the model means, relative to the folder; either slash separates, and where no file has
    /// that name one counts whose letters differ in their case: the first by its spelling, and none in a folder of more
    /// than 10,000 entries. `missing` where there is no ordinary file, and for names with a drive's letter. A folder is
    /// listed at most once; what was listed is kept, so one thread at a time may call this.
    [[nodiscard]] Named find(const std::string& written) const;

    /// The ordinary file of that name in a folder, with letters of another case as for find(); empty without one.
    [[nodiscard]] std::filesystem::path fileIn(const std::filesystem::path& folder, const std::string& name) const;

  private:
    [[nodiscard]] std::filesystem::path inOtherCase(const std::filesystem::path& name) const;
    /// The entry of a folder whose name differs from this one in the case of letters at most; empty without one.
    [[nodiscard]] std::filesystem::path spelledOtherwise(const std::filesystem::path& folder,
                                                         const std::string& name) const;

    std::filesystem::path folder_;
    std::filesystem::path resolved_;
    bool allowOutside_;
    /// Entries by their names in small letters, of the folders that were listed.
    mutable std::map<std::filesystem::path, std::map<std::string, std::string>> listed_;
};

}  // namespace lutka::animation::rig_import
