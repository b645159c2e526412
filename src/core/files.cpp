#include "core/files.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <system_error>

#include "core/input_file.hpp"
#include "core/temporary_file.hpp"

namespace lutka {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

Error outputError(const fs::path& file, const std::string& what, int errorNumber) {
    return {ErrorCode::output, fmt::format("{}: {}", what, std::strerror(errorNumber)), file.string(),
            "check that the folder is writable and that the disk has room"};
}

Result<void> writeTo(std::FILE* out, const fs::path& file, std::string_view bytes) {
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size();
    if (!written || std::fflush(out) != 0) return outputError(file, "can't be written", errno);
    return {};
}

Result<void> writeBytes(const fs::path& file, std::string_view bytes) {
    const File out(std::fopen(file.c_str(), "wb"));
    if (!out) return outputError(file, "can't be written", errno);
    return writeTo(out.get(), file, bytes);
}

// A file, or a folder that is in the way of one: what is neither has no second version to rename over it.
bool isStream(const fs::path& file) {
    std::error_code failed;
    return fs::exists(file, failed) && !fs::is_regular_file(file, failed) && !fs::is_directory(file, failed);
}

}  // namespace

Result<std::vector<unsigned char>> readFile(const fs::path& file, std::size_t maxBytes) {
    const Result<InputFile> in = InputFile::open(file);
    if (!in) return in.error();
    if (in.value().size() > maxBytes)
        return Error{ErrorCode::input, fmt::format("is larger than {} bytes", maxBytes), file.string(), ""};
    std::vector<unsigned char> bytes(in.value().size());
    if (const Result<void> whole = in.value().read(0, bytes); !whole) return whole.error();
    return bytes;
}

bool isStandardOutput(const fs::path& file) {
    return file == "-" || file == "/dev/stdout" || file == "/dev/fd/1" || file == "/proc/self/fd/1";
}

Result<fs::path> outputTarget(const fs::path& named) {
    constexpr int kMostLinks = 40;  // as many as the kernel follows
    fs::path file = named;
    std::error_code failed;
    for (int links = 0; fs::is_symlink(file, failed); ++links) {
        const fs::path target = fs::read_symlink(file, failed);
        if (links == kMostLinks || failed) return outputError(named, "can't be written", ELOOP);
        file = file.parent_path() / target;
    }
    return file;
}

Result<void> writeFileAtomically(const fs::path& named, const std::function<Result<void>(const fs::path&)>& write) {
    if (isStream(named) || isStandardOutput(named)) {
        return Error{ErrorCode::output, "is no ordinary file, and this output can't be streamed", named.string(),
                     "give the name of a file"};
    }
    const Result<fs::path> target = outputTarget(named);
    if (!target) return target.error();
    const fs::path& file = target.value();
    std::error_code failed;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), failed);
    if (failed) return outputError(file, "its folder can't be made", failed.value());
    if (fs::is_directory(file, failed)) return outputError(file, "can't be written", EISDIR);
    Result<TemporaryFile> temporary = TemporaryFile::beside(file, file.extension().string());
    if (!temporary) return temporary.error();
    Result<void> result = write(temporary.value().path());
    if (result) return temporary.value().replace(file);
    Error error = result.error();
    error.location = file.string();
    return error;
}

Result<void> writeFileAtomically(const fs::path& file, std::string_view bytes) {
    // By its own handle: the name of a redirected standard output is that of a file, which a rename would replace.
    if (isStandardOutput(file)) return writeTo(stdout, "standard output", bytes);
    if (isStream(file)) return writeBytes(file, bytes);
    return writeFileAtomically(file, [&](const fs::path& temporary) { return writeBytes(temporary, bytes); });
}

Result<fs::path> findAsset(std::string_view relativePath) {
    std::vector<fs::path> roots;
    if (const char* named = std::getenv("LUTKA_ASSETS"); named != nullptr) roots.emplace_back(named);
    std::error_code failed;
    const fs::path executable = fs::read_symlink("/proc/self/exe", failed);
    if (!failed) {
        fs::path folder = executable.parent_path();
        roots.push_back(folder.parent_path() / "share" / "lutka" / "assets");
        for (int up = 0; up < 4 && folder.has_relative_path(); ++up, folder = folder.parent_path()) {
            roots.push_back(folder / "assets");
        }
    }
    std::string looked;
    for (const fs::path& root : roots) {
        if (fs::exists(root / relativePath, failed)) return root / relativePath;
        looked += (looked.empty() ? "" : ", ") + root.string();
    }
    return Error{ErrorCode::input, fmt::format("the asset is missing; looked in {}", looked), std::string(relativePath),
                 "set LUTKA_ASSETS to the folder `assets` of the sources or of the installation"};
}

}  // namespace lutka
