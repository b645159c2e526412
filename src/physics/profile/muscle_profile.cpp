#include "physics/profile/muscle_profile.hpp"

namespace lutka::physics {

MuscleProfile muscleProfileOf(MusclePreset preset) {
    MuscleProfile muscles;
    switch (preset) {
        case MusclePreset::limp:
            muscles.frequencyHz = 0.0F;
            break;
        case MusclePreset::weak:
            muscles.frequencyHz = 1.5F;
            break;
        case MusclePreset::powered:
            break;
        case MusclePreset::stiff:
            muscles.frequencyHz = 30.0F;
            muscles.bounded = false;
            break;
    }
    return muscles;
}

}  // namespace lutka::physics
