#include "animation/import/uri.hpp"

#include <cctype>

namespace lutka::animation::rig_import {

std::string decodePercents(const std::string& uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escape = uri[i] == '%' && i + 2 < uri.size() &&
                            std::isxdigit(static_cast<unsigned char>(uri[i + 1])) != 0 &&
                            std::isxdigit(static_cast<unsigned char>(uri[i + 2])) != 0;
        if (escape) {
            out += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            out += uri[i];
        }
    }
    return out;
}

}  // namespace lutka::animation::rig_import
