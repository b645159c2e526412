#include "render/gl/environment_map.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "render/gl/shader_program.hpp"

namespace lutka::render {
namespace {

constexpr float kLargestHalf = 65504.0F;  // of a 16-bit float

void uploadLevel(GLint level, int width, int height, const std::vector<vec3>& radiance, long long& bytes) {
    std::vector<vec3> bounded(radiance);
    for (vec3& light : bounded)
        light = glm::min(light, vec3(kLargestHalf));
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGB16F, width, height, 0, GL_RGB, GL_FLOAT, bounded.data());
    constexpr long long kBytesATexel = 6;
    bytes += kBytesATexel * width * height;
}

// Round the horizon it goes on at the other end; at the poles it ends.
void setSampling(GLint minFilter) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minFilter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace

EnvironmentMap::EnvironmentMap(const Environment& environment)
    : panorama_(GlTexture::create()), reflections_(GlTexture::create()) {
    const EnvironmentLight light = makeEnvironmentLight(environment);
    diffuse_ = light.diffuse;
    panoramaGain_ = light.gain;
    lastLevel_ = static_cast<float>(light.reflections.size() - 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, panorama_.name());
    uploadLevel(0, environment.width, environment.height, environment.radiance, bytes_);
    setSampling(GL_LINEAR);
    glBindTexture(GL_TEXTURE_2D, reflections_.name());
    for (std::size_t i = 0; i < light.reflections.size(); ++i) {
        const EnvironmentLight::Level& level = light.reflections[i];
        uploadLevel(static_cast<GLint>(i), level.width, level.height, level.radiance, bytes_);
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(light.reflections.size() - 1));
    setSampling(GL_LINEAR_MIPMAP_LINEAR);
}

void EnvironmentMap::bind() const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(TextureUnit::environment));
    glBindTexture(GL_TEXTURE_2D, reflections_.name());
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(TextureUnit::panorama));
    glBindTexture(GL_TEXTURE_2D, panorama_.name());
}

}  // namespace lutka::render
