#include "render/gl/shader_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>
#include <sstream>

#include "core/files.hpp"

namespace lutka::render {
namespace {

// Line numbers that the compiler sees hold the file too, as GLSL knows no file names and Mesa drops the file's number
// from some of its messages: line n of file f is f * kLinesAFile + n.
constexpr std::size_t kLinesAFile = 100000;

// The text handed to the compiler.
struct Source {
    std::string text;
    std::vector<std::string> files;
};

Result<void> append(Source& source, const std::string& name) {
    if (std::find(source.files.begin(), source.files.end(), name) != source.files.end()) return {};
    const Result<std::filesystem::path> path = findAsset("shaders/" + name);
    if (!path) return path.error();
    const Result<std::vector<unsigned char>> bytes = readFile(path.value(), std::size_t{1} << 20U);
    if (!bytes) return bytes.error();
    const std::size_t index = source.files.size();
    source.files.push_back(name);
    source.text += fmt::format("#line {}\n", index * kLinesAFile + 1);
    std::istringstream lines(std::string(bytes.value().begin(), bytes.value().end()));
    std::size_t number = 1;
    for (std::string line; std::getline(lines, line); ++number) {
        constexpr std::string_view kInclude = "#include \"";
        if (line.rfind(kInclude, 0) != 0) {
            source.text += line + '\n';
            continue;
        }
        const std::size_t end = line.find('"', kInclude.size());
        Result<void> included = append(source, line.substr(kInclude.size(), end - kInclude.size()));
        if (!included) return included;
        source.text += fmt::format("#line {}\n", index * kLinesAFile + number + 1);
    }
    return {};
}

// "0:200023(4): error …" (Mesa) or "0(200023) : error …" (NVIDIA) with the file's name and line in its place.
Error compileError(const std::string& log, const Source& source) {
    Error error{ErrorCode::internal, "", source.files.front(), ""};
    const std::regex place(R"(\d+[:(](\d+)(\(\d+\)|\)))");
    std::string words;
    auto from = log.cbegin();
    for (std::smatch match; std::regex_search(from, log.cend(), match, place); from = match.suffix().first) {
        const std::size_t number = std::stoul(match[1].str());
        const std::size_t file = std::min(number / kLinesAFile, source.files.size() - 1);
        const std::string name = fmt::format("{}:{}", source.files[file], number % kLinesAFile);
        if (words.empty()) error.location = name;
        words.append(from, match[0].first).append(name);
    }
    words.append(from, log.cend());
    error.message = "the shader does not compile: " + words;
    return error;
}

// GL fills the buffer up to a null character.
std::string trimmed(std::string log) {
    log.resize(std::min(log.find('\0'), log.size()));
    while (!log.empty() && log.back() == '\n')
        log.pop_back();
    return log;
}

Result<GLuint> compile(GLenum stage, std::string_view file, std::span<const std::string> defines) {
    Source source;
    source.text = "#version 330 core\n";
    for (const std::string& define : defines)
        source.text += "#define " + define + "\n";
    const Result<void> read = append(source, std::string(file));
    if (!read) return read.error();
    const GLuint shader = glCreateShader(stage);
    const char* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint done = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done == GL_TRUE) return shader;
    std::string log(4096, '\0');
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    glDeleteShader(shader);
    return compileError(trimmed(log), source);
}

}  // namespace

Result<ShaderProgram> ShaderProgram::load(std::string_view vertexFile, std::string_view fragmentFile,
                                          std::span<const std::string> defines, std::span<const char* const> feedback) {
    ShaderProgram program;
    program.program_ = GlObject<ProgramTraits>::create();
    const GLuint name = program.name();
    const std::array<std::pair<GLenum, std::string_view>, 2> stages = {
        {{GL_VERTEX_SHADER, vertexFile}, {GL_FRAGMENT_SHADER, fragmentFile}}};
    for (const auto& [stage, file] : stages) {
        if (file.empty()) continue;
        const Result<GLuint> shader = compile(stage, file, defines);
        if (!shader) return shader.error();
        glAttachShader(name, shader.value());
        glDeleteShader(shader.value());  // lives on as long as the program holds it
    }
    if (!feedback.empty()) {
        glTransformFeedbackVaryings(name, static_cast<GLsizei>(feedback.size()), feedback.data(), GL_SEPARATE_ATTRIBS);
    }
    glLinkProgram(name);
    GLint done = GL_FALSE;
    glGetProgramiv(name, GL_LINK_STATUS, &done);
    if (done != GL_TRUE) {
        std::string log(4096, '\0');
        glGetProgramInfoLog(name, static_cast<GLsizei>(log.size()), nullptr, log.data());
        return Error{ErrorCode::internal, "the shaders do not link: " + trimmed(log),
                     fmt::format("{} + {}", vertexFile, fragmentFile), ""};
    }
    program.bindFixedUnits();
    return program;
}

void ShaderProgram::bindFixedUnits() const {
    use();
    const std::array<std::pair<const char*, TextureUnit>, 15> units = {{
        {"baseColorTexture", TextureUnit::baseColor},
        {"metallicRoughnessTexture", TextureUnit::metallicRoughness},
        {"normalTexture", TextureUnit::normal},
        {"occlusionTexture", TextureUnit::occlusion},
        {"emissiveTexture", TextureUnit::emissive},
        {"palettes", TextureUnit::palettes},
        {"instances", TextureUnit::instances},
        {"shadowMap", TextureUnit::shadowMap},
        {"shadowDepth", TextureUnit::shadowDepth},
        {"occlusionMap", TextureUnit::occlusionMap},
        {"depthMap", TextureUnit::depthMap},
        {"pictureDepth", TextureUnit::depthMap},
        {"noisyMap", TextureUnit::noisyMap},
        {"environmentMap", TextureUnit::environment},
        {"panorama", TextureUnit::panorama},
    }};
    for (const auto& [uniform, unit] : units)
        set(uniform, static_cast<int>(unit));
    const GLuint block = glGetUniformBlockIndex(name(), "Frame");
    if (block != GL_INVALID_INDEX) glUniformBlockBinding(name(), block, 0);
}

}  // namespace lutka::render
