#pragma once

#include <memory>
#include <string>
#include <vector>

namespace lutka::render {

/// What the driver says against the calls that it gets (KHR_debug): errors, undefined behaviour and what it finds slow,
/// of high and medium severity. What a shader's compiler says is not among them: ShaderProgram hands that on itself.
class DriverMessages {
  public:
    using Function = void (*)();
    using Loader = Function (*)(const char* name);

    /// Listens to the current context from now on, for as long as this lives, which makes drawing slower. `fatal`: the
    /// first message is printed and ends the program there and then, for a debugger and for tests. Null where the
    /// driver can't.
    [[nodiscard]] static std::unique_ptr<DriverMessages> listen(Loader loader, bool fatal);

    /// A sentence each, the first hundred.
    [[nodiscard]] const std::vector<std::string>& all() const { return messages_; }
    [[nodiscard]] bool fatal() const { return fatal_; }
    void add(std::string message);

  private:
    explicit DriverMessages(bool fatal) : fatal_(fatal) {}

    bool fatal_;
    std::vector<std::string> messages_;
};

/// Whether the current context has an extension, "GL_KHR_debug" for example.
[[nodiscard]] bool hasGlExtension(const char* name);

}  // namespace lutka::render
