#include "editor/document/mend_profile.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lutka::editor {
namespace {

using physics::Finding;

// What was asked to be mended and can be, but is there still.
std::vector<Finding> stillThere(const physics::RagdollProfile& profile, const animation::Character& character,
                                const animation::HumanoidMap& map, std::span<const Finding> asked) {
    std::vector<Finding> left = physics::diagnose(profile, character, map).findings;
    std::erase_if(left, [&](const Finding& finding) {
        return !finding.mendable || std::none_of(asked.begin(), asked.end(), [&](const Finding& one) {
            return one.mendable && one.code == finding.code && one.place == finding.place;
        });
    });
    return left;
}

}  // namespace

Result<physics::RagdollProfile> mendProfile(const physics::RagdollProfile& profile,
                                            const animation::Character& character, const animation::HumanoidMap& map,
                                            std::span<const Finding> findings) {
    constexpr int mostRounds = 8;
    std::vector<Finding> left(findings.begin(), findings.end());
    physics::RagdollProfile work = profile;
    for (int round = 0; round < mostRounds; ++round) {
        auto mended = physics::applyMends(work, character, map, left);
        if (!mended) return mended;
        work = std::move(mended).value();
        left = stillThere(work, character, map, findings);
        if (left.empty()) return work;
    }
    return Error{ErrorCode::input,
                 fmt::format("{} of {} comes back however often it is mended", left.front().code, left.front().place),
                 "", "look at the mapping of its joints first"};
}

}  // namespace lutka::editor
