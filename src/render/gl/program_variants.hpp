#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "render/gl/shader_program.hpp"

namespace lutka::render {

/// What a lit program is compiled for, as bits; each is a define of the same name in assets/shaders.
enum ProgramFeature : unsigned {
    kBaseTexture = 1U << 0U,
    kMetallicRoughnessTexture = 1U << 1U,
    kNormalTexture = 1U << 2U,
    kOcclusionTexture = 1U << 3U,
    kEmissiveTexture = 1U << 4U,
    kAlphaMask = 1U << 5U,
    kLocalLights = 1U << 6U,      ///< There are some.
    kUnshadowed = 1U << 7U,       ///< The sun casts no shadow.
    kFastShading = 1U << 8U,      ///< Fewer taps, for software rasterisers.
    kUnoccluded = 1U << 9U,       ///< There is no ambient occlusion.
    kEnvironmentMap = 1U << 10U,  ///< Light comes from an .hdr picture, not from the procedural sky.
    kVertexColors = 1U << 11U,
};

/// The programs of one pair of shader files, one a set of features: what a program does not need is not compiled in, as
/// on a software rasteriser every fetch counts.
class ProgramVariants {
  public:
    ProgramVariants(const char* vertexFile, const char* fragmentFile)
        : vertexFile_(vertexFile), fragmentFile_(fragmentFile) {}

    /// Compiles that variant, unless it is there. Fails as ShaderProgram::load().
    [[nodiscard]] Result<void> prepare(unsigned features);

    /// The program for `features` with `lighting` on top. `features` were prepared; the variant with `lighting` is
    /// compiled on its first use. A driver that refuses it gets the plain one, and the reason goes to `warnings`.
    [[nodiscard]] const ShaderProgram& at(unsigned features, unsigned lighting, std::vector<std::string>& warnings);

  private:
    const char* vertexFile_;
    const char* fragmentFile_;
    std::map<unsigned, ShaderProgram> programs_;
    std::set<unsigned> refused_;
};

}  // namespace lutka::render
