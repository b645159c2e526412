#include "animation/import/unread_format.hpp"
#include "core/letter_case.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace lutka::animation::rig_import {
namespace {

using namespace std::string_view_literals;

struct Format {
    std::string_view start;      // the file's first bytes
    std::string_view extension;  // with the dot; empty: any
    const char* what;
    const char* mend;
};

constexpr const char* kFromProgram = "open it in the program that wrote it and export glTF 2.0 or FBX";
constexpr const char* kFromBlender = "open it in Blender and export glTF 2.0 or FBX";

constexpr std::array kFormats = {
    Format{"UMDL", "", "a model of the Urho3D engine", "take the FBX or glTF file that it was made from"},
    Format{"UMD2", "", "a model of the Urho3D engine", "take the FBX or glTF file that it was made from"},
    Format{"Pmd\0\0\x80\x3f"sv, "", "a model of MikuMikuDance in its old format, PMD",
           "save it as PMX (PMX Editor), or import it into Blender (MMD Tools) and export glTF 2.0"},
    Format{"Vocaloid Motion Data", "", "a motion of MikuMikuDance without a model", "take the model (PMX) itself"},
    Format{"\xD0\xCF\x11\xE0", ".max", "a scene of 3ds Max", kFromProgram},
    Format{"//Maya ASCII", "", "a scene of Maya", kFromProgram},
    Format{"FOR4", ".mb", "a scene of Maya", kFromProgram},
    Format{"FOR8", ".mb", "a scene of Maya", kFromProgram},
    Format{"QC4DC4D6", "", "a scene of Cinema 4D", kFromProgram},
    Format{"\x28\xB5\x2F\xFD", ".blend", "a compressed scene of Blender", "open it in Blender and export glTF 2.0"},
    Format{"\x1F\x8B", ".blend", "a compressed scene of Blender", "open it in Blender and export glTF 2.0"},
    // Assimp reads their meshes, of older versions, and never their armatures.
    Format{"BLENDER", "", "a scene of Blender", "open it in Blender and export glTF 2.0"},
    Format{"PXR-USDC", "", "a USD file", kFromBlender},
    Format{"#usda", "", "a USD file", kFromBlender},
    Format{"PK\x03\x04", ".usdz", "a USD file", kFromBlender},
    Format{"\xC1\x83\x2A\x9E", "", "an asset of Unreal Engine",
           "export the skeletal mesh as FBX or glTF 2.0 in the editor"},
    Format{"%YAML", "", "an asset of Unity", "take the FBX file that it was made from, or export one (FBX Exporter)"},
    Format{"UnityFS", "", "an asset bundle of Unity", "take the FBX file that it was made from"},
    Format{"RSRC", "", "a resource of the Godot engine", "take the glTF or FBX file that it was made from"},
    Format{"", ".j3o", "a model of jMonkeyEngine", "take the glTF or Ogre file that it was made from"},
};

}  // namespace

std::optional<Error> unreadFormat(const std::filesystem::path& file, std::string_view start) {
    const std::string extension = lowerCased(file.extension().string());
    const auto found = std::find_if(kFormats.begin(), kFormats.end(), [&](const Format& format) {
        return start.starts_with(format.start) && (format.extension.empty() || extension == format.extension);
    });
    if (found == kFormats.end()) return std::nullopt;
    return Error{ErrorCode::input, std::string("is ") + found->what + ", which can't be read", file.string(),
                 found->mend};
}

}  // namespace lutka::animation::rig_import
