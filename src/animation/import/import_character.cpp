#include "animation/import/import_character.hpp"
