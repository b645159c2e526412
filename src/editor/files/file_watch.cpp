#include "editor/files/file_watch.hpp"

namespace lutka::editor {

void FileWatch::watch(const std::filesystem::path& file) {
    file_ = file;
    known_ = last_ = look();
    waited_ = 0.0;
}

bool FileWatch::changed(double seconds) {
    waited_ += seconds;
    if (file_.empty() || waited_ < kEverySeconds) return false;
    waited_ = 0.0;
    const std::optional<Seen> now = look();
    const bool settled = now == last_;
    last_ = now;
    // A file that is gone for the moment is being replaced.
    if (!now || !settled || now == known_) return false;
    known_ = now;
    return true;
}

std::optional<FileWatch::Seen> FileWatch::look() const {
    std::error_code failed;
    const auto time = std::filesystem::last_write_time(file_, failed);
    if (failed) return std::nullopt;
    const std::uintmax_t bytes = std::filesystem::file_size(file_, failed);
    return failed ? std::nullopt : std::optional(Seen{time, bytes});
}

}  // namespace lutka::editor
