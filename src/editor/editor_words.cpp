#include "editor/editor_words.hpp"

#include <array>
#include <string_view>

namespace lutka::editor {
namespace {

struct Saying {
    std::string_view terminal;
    std::string_view editor;
};

// The longer ones come first: later ones are parts of them.
constexpr std::array kSayings{
    Saying{"`lutka inspect` shows the joint tree; a humanoid has a trunk, two arms and two legs. `--rig any`, in "
           "scenes and lists \"rig\": \"any\", makes a ragdoll of any skeleton",
           "a humanoid has a trunk, two arms and two legs; of a character of the scene \"Taken as\" (tab Scene) may be "
           "any "
           "skeleton"},
    Saying{"look at `lutka map` and bind the roles by hand, or take `--rig any`",
           "bind the roles by hand in the tab Mapping"},
    Saying{"`lutka build MODEL` lists the bodies", "the tab Body lists the bodies"},
    Saying{"make it anew with `lutka simulate --record`", "record it anew in the tab Physics"},
    Saying{"build a profile for this rig (`lutka build`)",
           "keep the fitted ragdoll, or save one for this rig (Ctrl+S)"},
    Saying{"`lutka inspect` lists the figures of a file", "File > Figure of the file lists them"},
    Saying{"(`lutka inspect` lists all)", "(F4 shows all)"},
    Saying{"(--figure ", "(File > Figure of the file, number "},
    Saying{"`lutka render --skinning dual` draws", "\"Dual quaternion skin\" in the tab View draws"},
    Saying{"(--masses balanced)", "(Masses in the tab Physics: balanced)"},
    Saying{"--allow-outside", "\"Take files from outside of a model's folder\" (File menu)"},
    Saying{"(--up overrides)", "(`lutka edit --up` overrides)"},
    Saying{"(--scale overrides)", "(`lutka edit --scale` overrides)"},
    Saying{"--import-memory allows", "starting with `lutka edit --import-memory` allows"},
    Saying{"--in-process reads", "starting with `lutka edit --in-process` reads"},
    Saying{"--in-process may", "starting with `lutka edit --in-process` may"},
    Saying{"name a joint for it, if there is one: --map", "bind a joint to it in the tab Mapping, if there is one"},
};

}  // namespace

std::string inEditorWords(std::string text) {
    for (const Saying& saying : kSayings) {
        for (std::size_t at = text.find(saying.terminal); at != std::string::npos;
             at = text.find(saying.terminal, at + saying.editor.size()))
            text.replace(at, saying.terminal.size(), saying.editor);
    }
    return text;
}

}  // namespace lutka::editor
