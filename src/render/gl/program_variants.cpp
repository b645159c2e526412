#include "render/gl/program_variants.hpp"

#include <array>
#include <utility>

#include "core/assert.hpp"

namespace lutka::render {
namespace {

std::vector<std::string> definesOf(unsigned features) {
    constexpr std::array<std::pair<unsigned, const char*>, 12> kNames = {{
        {kBaseTexture, "BASE_TEXTURE"},
        {kMetallicRoughnessTexture, "METALLIC_ROUGHNESS_TEXTURE"},
        {kNormalTexture, "NORMAL_TEXTURE"},
        {kOcclusionTexture, "OCCLUSION_TEXTURE"},
        {kEmissiveTexture, "EMISSIVE_TEXTURE"},
        {kAlphaMask, "ALPHA_MASK"},
        {kLocalLights, "LOCAL_LIGHTS"},
        {kUnshadowed, "UNSHADOWED"},
        {kFastShading, "FAST"},
        {kUnoccluded, "UNOCCLUDED"},
        {kEnvironmentMap, "ENVIRONMENT_MAP"},
        {kVertexColors, "VERTEX_COLORS"},
    }};
    std::vector<std::string> defines;
    for (const auto& [bit, name] : kNames) {
        if ((features & bit) != 0) defines.emplace_back(name);
    }
    return defines;
}

}  // namespace

Result<void> ProgramVariants::prepare(unsigned features) {
    if (programs_.contains(features)) return {};
    Result<ShaderProgram> loaded = ShaderProgram::load(vertexFile_, fragmentFile_, definesOf(features));
    if (!loaded) return loaded.error();
    programs_.emplace(features, std::move(loaded).value());
    return {};
}

const ShaderProgram& ProgramVariants::at(unsigned features, unsigned lighting, std::vector<std::string>& warnings) {
    const unsigned wanted = features | lighting;
    const auto known = programs_.find(wanted);
    if (known != programs_.end()) return known->second;
    if (!refused_.contains(wanted)) {
        const Result<void> made = prepare(wanted);
        if (made) return programs_.at(wanted);
        warnings.push_back(made.error().text());
        refused_.insert(wanted);
    }
    const auto plain = programs_.find(features);
    LUTKA_ASSERT(plain != programs_.end());
    return plain->second;
}

}  // namespace lutka::render
