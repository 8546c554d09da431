// What the made scenes of the mesh benchmark are put together with.
#pragma once

#include "tessera/scene.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <string>
#include <vector>

namespace tessera::bench {

// Turns the z axis up to y: surfaces of revolution (tessera/surfaces.h) lie around z.
[[nodiscard]] glm::quat upright();

// Takes `mesh`, unless the scene has one of this name. Returns the name.
std::string addMesh(Scene& scene, Mesh mesh);

// Places the scene's mesh `mesh`; the object is named after it, with a number.
void place(Scene& scene, const std::string& mesh, const glm::vec3& at, const glm::quat& turned, const glm::vec3& color);

// Adds a camera of this name.
void addView(Scene& scene, const std::string& name, const glm::vec3& eye, const glm::vec3& target, float fovyDegrees);

// A lamp behind the viewer and a sky.
void addLamps(Scene& scene);

}  // namespace tessera::bench
