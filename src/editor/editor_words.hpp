#pragma once

#include <string>

namespace lutka::editor {

/// What a message of the libraries says to somebody who has the editor before them: where it names a command or an
/// option of the command line, the button or the menu that does the same, and where there is none, the option that
/// `lutka edit` is started with. Any other text is left as it is. All that Workspace tells goes through it.
[[nodiscard]] std::string inEditorWords(std::string text);

}  // namespace lutka::editor
