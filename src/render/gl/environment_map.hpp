#pragma once

#include <array>

#include "render/environment.hpp"
#include "render/gl/gl_object.hpp"

namespace lutka::render {

/// A panorama on the GPU: as it is (for the background) and as light.
class EnvironmentMap {
  public:
    explicit EnvironmentMap(const Environment& environment);

    void bind() const;
    [[nodiscard]] const std::array<vec3, 9>& diffuse() const { return diffuse_; }
    /// The level of full roughness.
    [[nodiscard]] float lastLevel() const { return lastLevel_; }
    /// What the panorama is multiplied by to be as bright as its light.
    [[nodiscard]] float panoramaGain() const { return panoramaGain_; }
    [[nodiscard]] long long bytes() const { return bytes_; }

  private:
    GlTexture panorama_;
    GlTexture reflections_;
    std::array<vec3, 9> diffuse_{};
    float lastLevel_ = 0.0F;
    float panoramaGain_ = 1.0F;
    long long bytes_ = 0;
};

}  // namespace lutka::render
