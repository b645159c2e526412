#include "animation/humanoid/map_humanoid.hpp"
