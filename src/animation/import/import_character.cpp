#include "animation/import/import_character.hpp"

#include <cmath>

#include "animation/import/build_character.hpp"
#include "animation/import/source_reader.hpp"

namespace lutka::animation {

Result<Character> importCharacter(const std::filesystem::path& file, const ImportOptions& options) {
    if (options.metresPerFileUnit &&
        !(std::isfinite(*options.metresPerFileUnit) && *options.metresPerFileUnit > 0.0F)) {
        return Error{ErrorCode::usage, "the scale must be a number above zero", "", ""};
    }
    Result<rig_import::SourceScene> source = rig_import::readSource(file, options);
    if (!source) return source.error();
    return rig_import::buildCharacter(std::move(source).value(), file, options);
}

}  // namespace lutka::animation
