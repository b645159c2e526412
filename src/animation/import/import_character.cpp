#include "animation/import/import_character.hpp"

#include <cmath>
#include <optional>

#include "animation/import/build_character.hpp"
#include "animation/import/isolated_reading.hpp"
#include "animation/import/source_reader.hpp"
#include "core/stdout_aside.hpp"

namespace lutka::animation {
namespace {

rig_import::Isolation isolationOf(const ImportWorker& worker) {
    rig_import::Isolation isolation;
    isolation.program = worker.program;
    isolation.limits.memoryBytes = worker.memoryBytes;
    isolation.limits.seconds = worker.seconds;
    isolation.stop = worker.stop;
    isolation.printed = worker.printed;
    return isolation;
}

Result<rig_import::SourceScene> readHere(const std::filesystem::path& file, const ImportOptions& options) {
    std::optional<StdoutAside> aside;
    if (options.stdoutAside) aside.emplace();
    return rig_import::readSource(file, options);
}

}  // namespace

Result<Character> importCharacter(const std::filesystem::path& file, const ImportOptions& options) {
    if (options.metresPerFileUnit &&
        !(std::isfinite(*options.metresPerFileUnit) && *options.metresPerFileUnit > 0.0F)) {
        return Error{ErrorCode::usage, "the scale must be a number above zero", "", ""};
    }
    Result<rig_import::SourceScene> source = options.worker.program.empty()
                                                 ? readHere(file, options)
                                                 : rig_import::readIsolated(file, options, isolationOf(options.worker));
    if (!source) return source.error();
    return rig_import::buildCharacter(std::move(source).value(), file, options);
}

int serveImport(const std::vector<std::string>& arguments) {
    return rig_import::serveReading(arguments, rig_import::readSource);
}

bool asksForImport(const std::string& argument) {
    return argument == rig_import::kReadingCommand;
}

}  // namespace lutka::animation
