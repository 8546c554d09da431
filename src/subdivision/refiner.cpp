// OpenSubdiv's view of a clean cage.
#include "subdivision/refiner.h"

#include <opensubdiv/far/topologyDescriptor.h>

#include <string>
#include <vector>

#include "scene/text.h"
#include "tessera/error.h"

namespace tessera::subdivision {

namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

std::vector<int> ints(const std::vector<std::uint32_t>& numbers) { return {numbers.begin(), numbers.end()}; }

Sdc::SchemeType schemeType(SubdivisionScheme scheme) {
    if (scheme == SubdivisionScheme::loop) return Sdc::SCHEME_LOOP;
    return scheme == SubdivisionScheme::bilinear ? Sdc::SCHEME_BILINEAR : Sdc::SCHEME_CATMARK;
}

Sdc::Options::VtxBoundaryInterpolation boundaryRule(BoundaryRule rule) {
    if (rule == BoundaryRule::none) return Sdc::Options::VTX_BOUNDARY_NONE;
    return rule == BoundaryRule::edgeOnly ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY : Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER;
}

}  // namespace

std::unique_ptr<Refiner> makeRefiner(const Cage& cage) {
    const std::vector<int> sizes = ints(cage.faceSizes), vertices = ints(cage.faceVertices), holes = ints(cage.holes);
    const std::vector<int> textures = ints(cage.faceTexturePoints);
    std::vector<int> creases, corners;
    std::vector<float> creaseSharpness, cornerSharpness;
    for (const Crease& crease : cage.creases) {
        creases.insert(creases.end(), {static_cast<int>(crease.a), static_cast<int>(crease.b)});
        creaseSharpness.push_back(crease.sharpness);
    }
    for (const Corner& corner : cage.corners) {
        corners.push_back(static_cast<int>(corner.vertex));
        cornerSharpness.push_back(corner.sharpness);
    }
    using Descriptor = Far::TopologyDescriptor;
    Descriptor::FVarChannel channel;
    channel.numValues = static_cast<int>(cage.texturePoints.size());
    channel.valueIndices = textures.data();
    Descriptor topology;
    topology.numVertices = static_cast<int>(cage.points.size());
    topology.numFaces = static_cast<int>(sizes.size());
    topology.numVertsPerFace = sizes.data();
    topology.vertIndicesPerFace = vertices.data();
    topology.numCreases = static_cast<int>(creaseSharpness.size());
    topology.creaseVertexIndexPairs = creases.data();
    topology.creaseWeights = creaseSharpness.data();
    topology.numCorners = static_cast<int>(corners.size());
    topology.cornerVertexIndices = corners.data();
    topology.cornerWeights = cornerSharpness.data();
    topology.numHoles = static_cast<int>(holes.size());
    topology.holeIndices = holes.data();
    topology.numFVarChannels = textures.empty() ? 0 : 1;
    topology.fvarChannels = textures.empty() ? nullptr : &channel;

    Sdc::Options rules;
    rules.SetVtxBoundaryInterpolation(boundaryRule(cage.boundary));
    rules.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1);
    using Factory = Far::TopologyRefinerFactory<Descriptor>;
    const Factory::Options options(schemeType(cage.scheme), rules);
    std::unique_ptr<Refiner> refiner(Factory::Create(topology, options));
    if (refiner == nullptr) throw Error("cage " + quotedName(cage.name) + ": OpenSubdiv takes no such topology; repair the cage");
    return refiner;
}

}  // namespace tessera::subdivision
