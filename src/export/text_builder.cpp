#include "export/text_builder.hpp"

namespace lutka::exporting {

std::string quotedText(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else {
            out += static_cast<unsigned char>(c) < 0x20 ? '_' : c;
        }
    }
    return out + '"';
}

}  // namespace lutka::exporting
