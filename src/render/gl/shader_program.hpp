#pragma once

#include <glad/gl.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/math.hpp"
#include "core/result.hpp"
#include "render/gl/gl_object.hpp"

namespace lutka::render {

struct ProgramTraits {
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint name) { glDeleteProgram(name); }
};

/// Fixed texture units, the same in every program.
enum class TextureUnit : int {
    baseColor,
    metallicRoughness,
    normal,
    occlusion,
    emissive,
    palettes,
    instances,
    shadowMap,
    shadowDepth,
    occlusionMap,
    depthMap,
    noisyMap,
    environment,
    panorama
};

/// A linked GL program made from files of assets/shaders. The files have no #version line; they may name others by
/// #include "file.glsl" (each is taken once).
class ShaderProgram {
  public:
    /// `fragmentFile` may be empty for transform feedback, which captures `feedback` (separate buffers). `defines` are
    /// names that #ifdef sees. Fails with ErrorCode::input for a missing file, with ErrorCode::internal and the
    /// compiler's words, naming file and line, otherwise.
    [[nodiscard]] static Result<ShaderProgram> load(std::string_view vertexFile, std::string_view fragmentFile,
                                                    std::span<const std::string> defines = {},
                                                    std::span<const char* const> feedback = {});

    ShaderProgram() = default;

    void use() const { glUseProgram(program_.name()); }
    [[nodiscard]] GLuint name() const { return program_.name(); }

    /// Sets a uniform of the program in use; names that the compiler dropped are passed over.
    void set(const char* uniform, int value) const { glUniform1i(location(uniform), value); }
    void set(const char* uniform, float value) const { glUniform1f(location(uniform), value); }
    void set(const char* uniform, const vec2& value) const { glUniform2f(location(uniform), value.x, value.y); }
    void set(const char* uniform, const vec3& value) const {
        glUniform3f(location(uniform), value.x, value.y, value.z);
    }
    void set(const char* uniform, const vec4& value) const {
        glUniform4f(location(uniform), value.x, value.y, value.z, value.w);
    }
    void set(const char* uniform, const mat4& value) const {
        glUniformMatrix4fv(location(uniform), 1, GL_FALSE, &value[0][0]);
    }

  private:
    [[nodiscard]] GLint location(const char* uniform) const { return glGetUniformLocation(program_.name(), uniform); }
    void bindFixedUnits() const;

    GlObject<ProgramTraits> program_;
};

}  // namespace lutka::render
