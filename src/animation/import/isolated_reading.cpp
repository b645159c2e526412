#include "animation/import/isolated_reading.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <sstream>
#include <system_error>

#include "animation/import/scene_blob.hpp"
#include "core/utf8.hpp"

namespace lutka::animation::rig_import {
namespace {

// Exit codes of the serving process beside 0.
constexpr int kWrongCall = 2;
constexpr int kNobodyListens = 3;
constexpr int kOutOfMemory = 4;

constexpr std::size_t kArgumentCount = 6;  // the command, the file, pictures, files outside, bytes of memory, seconds

const char* const kExportAgain = "it is damaged or made to do harm; export it again as glTF 2.0 or FBX";

std::vector<std::string> callOf(const std::filesystem::path& file, const ImportOptions& options,
                                const Isolation& isolation) {
    return {isolation.program.string(),
            kReadingCommand,
            file.string(),
            options.loadTextures ? "1" : "0",
            options.allowOutside ? "1" : "0",
            std::to_string(isolation.limits.memoryBytes),
            std::to_string(isolation.limits.seconds)};
}

template <class Number>
std::optional<Number> numberIn(const std::string& text) {
    Number number{};
    const char* end = text.data() + text.size();
    const auto [stopped, failed] = std::from_chars(text.data(), end, number);
    if (failed != std::errc() || stopped != end) return std::nullopt;
    return number;
}

Error crashError(const std::filesystem::path& file, int signal) {
    return {ErrorCode::input, fmt::format("the importer crashed over it (signal {}, {})", signal, ::strsignal(signal)),
            file.string(), kExportAgain};
}

// What a process that did not hand a scene over means to the user.
Error errorOf(const ProcessEnd& end, const std::filesystem::path& file, const ProcessLimits& limits) {
    constexpr std::size_t mebibyte = std::size_t{1} << 20U;
    const bool memory = end.exitCode == kOutOfMemory || end.kind == ProcessEnd::Kind::tooMuchSaid;
    if (memory) {
        return {ErrorCode::input,
                fmt::format("needs more than {} MiB of memory to be read", limits.memoryBytes / mebibyte),
                file.string(), "--import-memory allows more, for files that you trust"};
    }
    switch (end.kind) {
        case ProcessEnd::Kind::crashed:
            return crashError(file, end.signal);
        case ProcessEnd::Kind::outOfTime:
            return {ErrorCode::input, fmt::format("takes more than {} seconds to be read", limits.seconds),
                    file.string(), "--in-process reads without limits, files that you trust"};
        case ProcessEnd::Kind::stopped:
            return {ErrorCode::input, "reading was stopped", file.string(), ""};
        case ProcessEnd::Kind::finished:
        case ProcessEnd::Kind::tooMuchSaid:
            break;
    }
    return {ErrorCode::internal, fmt::format("the importing process ended with {}", end.exitCode), file.string(),
            "--in-process may tell more"};
}

// Passes on what the readers printed, which may hold whatever the file does: fit for a terminal.
void tellPrinted(const std::string& printed, const std::function<void(const std::string& line)>& tell) {
    std::istringstream lines(printed);
    for (std::string line; std::getline(lines, line);) {
        line = withoutControls(wellFormedUtf8(line, "?"), ' ');
        if (line.find_first_not_of(' ') == std::string::npos) continue;
        if (tell)
            tell(line);
        else
            std::fprintf(stderr, "%s\n", line.c_str());
    }
}

bool writeAll(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(kConfinedOutput, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

Result<SourceScene> readCaught(const Reader& reader, const std::filesystem::path& file, const ImportOptions& options) {
    try {
        return reader(file, options);
    } catch (const std::exception& failure) {
        return Error{ErrorCode::input, std::string("can't be imported: ") + failure.what(), file.string(), ""};
    }
}

}  // namespace

Result<SourceScene> readIsolated(const std::filesystem::path& file, const ImportOptions& options,
                                 const Isolation& isolation) {
    std::error_code failed;
    if (!std::filesystem::exists(file, failed))
        return Error{ErrorCode::input, "there is no such file", file.string(), ""};
    if (!std::filesystem::is_regular_file(file, failed))
        return Error{ErrorCode::input, "is no ordinary file", file.string(), "give the file of a model"};
    const Result<ProcessEnd> ended = runConfined(callOf(file, options, isolation), isolation.limits, isolation.stop);
    if (!ended) return ended.error();
    const ProcessEnd& end = ended.value();
    tellPrinted(end.printed, isolation.printed);
    if (end.kind != ProcessEnd::Kind::finished || end.exitCode != 0) return errorOf(end, file, isolation.limits);
    return unpackScene(end.output, file.string());
}

int serveReading(const std::vector<std::string>& arguments, const Reader& reader) {
    if (arguments.size() != kArgumentCount || arguments[0] != kReadingCommand) return kWrongCall;
    const auto memory = numberIn<std::size_t>(arguments[4]);
    const auto seconds = numberIn<int>(arguments[5]);
    if (!memory || !seconds || *seconds <= 0) return kWrongCall;
    ProcessLimits limits;
    limits.memoryBytes = *memory;
    limits.seconds = *seconds;
    confineThisProcess(limits);
    // Third parties catch what `new` throws and make something else of it; the parent is to know what it was.
    std::set_new_handler([] { ::_exit(kOutOfMemory); });
    ImportOptions options;
    options.loadTextures = arguments[2] == "1";
    options.allowOutside = arguments[3] == "1";
    const std::string bytes = packScene(readCaught(reader, arguments[1], options));
    return writeAll(bytes) ? 0 : kNobodyListens;
}

}  // namespace lutka::animation::rig_import
