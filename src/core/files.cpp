#include "core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <system_error>

namespace lutka {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

Error inputError(const fs::path& file, std::string message) {
    return {ErrorCode::input, std::move(message), file.string(), ""};
}

Error outputError(const fs::path& file, const std::string& what, int errorNumber) {
    return {ErrorCode::output, fmt::format("{}: {}", what, std::strerror(errorNumber)), file.string(),
            "check that the folder is writable and that the disk has room"};
}

// Beside the target, so that the rename stays on one file system; the process id keeps two writers apart.
fs::path temporaryBeside(const fs::path& file) {
    fs::path temporary = file;
    temporary.replace_filename(fmt::format(".{}.{}{}", file.stem().string(), ::getpid(), file.extension().string()));
    return temporary;
}

// Data first, name second: without this a crash after the rename can leave an empty file under the final name.
Result<void> flushToDisk(const fs::path& file) {
    const int handle = ::open(file.c_str(), O_RDONLY);
    if (handle < 0) return outputError(file, "can't be written", errno);
    const bool synced = ::fsync(handle) == 0 || errno == EINVAL;
    const int why = errno;
    ::close(handle);
    if (!synced) return outputError(file, "can't be written", why);
    return {};
}

Result<void> writeBytes(const fs::path& file, std::string_view bytes) {
    File out(std::fopen(file.c_str(), "wb"));
    if (!out) return outputError(file, "can't be written", errno);
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), out.get()) == bytes.size();
    if (!written || std::fflush(out.get()) != 0) return outputError(file, "can't be written", errno);
    return {};
}

}  // namespace

Result<std::vector<unsigned char>> readFile(const fs::path& file, std::size_t maxBytes) {
    std::error_code failed;
    if (fs::is_directory(file, failed)) return inputError(file, "is a folder, not a file");
    File in(std::fopen(file.c_str(), "rb"));
    if (!in) return inputError(file, fmt::format("can't be read: {}", std::strerror(errno)));
    const std::uintmax_t size = fs::file_size(file, failed);
    if (failed) return inputError(file, fmt::format("can't be read: {}", failed.message()));
    if (size > maxBytes) return inputError(file, fmt::format("is larger than {} bytes", maxBytes));
    std::vector<unsigned char> bytes(size);
    if (std::fread(bytes.data(), 1, size, in.get()) != size) return inputError(file, "can't be read to its end");
    return bytes;
}

Result<void> writeFileAtomically(const fs::path& named, const std::function<Result<void>(const fs::path&)>& write) {
    std::error_code failed;
    // What a link names is replaced, not the link; a device or pipe has no second version to rename over it.
    const fs::path file = fs::is_symlink(named, failed) ? fs::weakly_canonical(named, failed) : named;
    if (fs::exists(file, failed) && !fs::is_regular_file(file, failed) && !fs::is_directory(file, failed)) {
        return Error{ErrorCode::output, "is no ordinary file, and this output can't be streamed", named.string(),
                     "give the name of a file"};
    }
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), failed);
    if (failed) return outputError(file, "its folder can't be made", failed.value());
    if (fs::is_directory(file, failed)) return outputError(file, "can't be written", EISDIR);
    const fs::path temporary = temporaryBeside(file);
    Result<void> result = write(temporary);
    if (result) result = flushToDisk(temporary);
    if (result && std::rename(temporary.c_str(), file.c_str()) != 0) {
        result = outputError(file, "can't be written", errno);
    }
    if (!result) {
        fs::remove(temporary, failed);
        Error error = result.error();
        error.location = file.string();
        return error;
    }
    return result;
}

Result<void> writeFileAtomically(const fs::path& file, std::string_view bytes) {
    std::error_code failed;
    const bool stream =
        fs::exists(file, failed) && !fs::is_regular_file(file, failed) && !fs::is_directory(file, failed);
    if (stream) return writeBytes(file, bytes);  // /dev/stdout, a pipe
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
