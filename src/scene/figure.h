// A cage such as modellers make of characters, made by rule.
#pragma once

#include "tessera/cage.h"

namespace tessera {

// A closed figure of 9984 quadrilaterals (and vertices two more) around the y axis, standing on y = 0, some 7 high: a body with head, arms,
// hands with fingers, legs and feet. Irregular vertices have valence 3, 5 and 6, where limbs begin and end.
[[nodiscard]] Cage figureCage();

}  // namespace tessera
