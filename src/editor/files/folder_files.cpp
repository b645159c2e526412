#include "editor/files/folder_files.hpp"

#include <algorithm>
#include <vector>

#include "editor/files/file_list.hpp"
#include "scene/description/scene_file.hpp"

namespace lutka::editor {

namespace fs = std::filesystem;

fs::path fileBeside(const fs::path& file, int step) {
    std::error_code failed;
    const fs::path folder = fs::absolute(file, failed).parent_path();
    std::vector<std::string> models;
    for (const FileEntry& entry : listFolder(folder, FileFilter::models)) {
        if (!entry.folder && isModel(entry.name)) models.push_back(entry.name);
    }
    const auto here = std::find(models.begin(), models.end(), file.filename().string());
    const int count = static_cast<int>(models.size());
    if (here == models.end()) return count > 0 ? folder / models.front() : fs::path();
    if (count < 2) return {};
    const int at = static_cast<int>(here - models.begin()) + step;
    return folder / models[static_cast<std::size_t>(((at % count) + count) % count)];
}

fs::path fileToOpen(const std::vector<std::string>& dropped) {
    std::vector<fs::path> files;
    for (const std::string& one : dropped) {
        std::error_code failed;
        if (!fs::is_directory(one, failed)) {
            files.emplace_back(one);
            continue;
        }
        for (const FileEntry& entry : listFolder(one, FileFilter::models)) {
            if (!entry.folder) files.push_back(fs::path(one) / entry.name);
        }
    }
    const auto scene =
        std::find_if(files.begin(), files.end(), [](const fs::path& f) { return scene::isSceneFile(f); });
    if (scene != files.end()) return *scene;
    const auto model =
        std::find_if(files.begin(), files.end(), [](const fs::path& f) { return isModel(f.filename().string()); });
    return model != files.end() ? *model : fs::path(dropped.front());
}

}  // namespace lutka::editor
