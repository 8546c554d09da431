# Micropolis' scene files, as its .mscene files hold them, and Tessera's additions.
# Ordinals are the format: never renumber or reuse one, extend with the next free ordinal only.
@0xe2b1a4424e280f7b;

using Cxx = import "/capnp/c++.capnp";
$Cxx.namespace("tessera::schema");

struct Vec3 {
  x @0 :Float32;
  y @1 :Float32;
  z @2 :Float32;
}

struct Quaternion {
  r @0 :Float32;
  i @1 :Float32;
  j @2 :Float32;
  k @3 :Float32;
}

# First the rotation, then the translation.
struct Transform {
  translation @0 :Vec3;
  rotation @1 :Quaternion;
}

struct Camera {
  name @0 :Text;
  transform @1 :Transform;
  near @2 :Float32;
  far @3 :Float32;
  fovy @4 :Float32;  # vertical field of view, degrees
}

struct LightSource {
  enum Type {
    point @0;
    directional @1;
    hemi @2;
  }

  name @0 :Text;
  transform @1 :Transform;
  color @2 :Vec3;
  intensity @3 :Float32;
  type @4 :Type;
}

# Tessera's own: an object without one is matte, which is what Micropolis' files mean.
struct Material {
  enum Kind {
    matte @0;
    plastic @1;
  }

  kind @0 :Kind;
  specular @1 :Float32;   # strength of the highlight, 0 to 1
  roughness @2 :Float32;  # width of the highlight, above 0 to 1
}

struct Object {
  name @0 :Text;
  transform @1 :Transform;
  meshname @2 :Text;
  color @3 :Vec3;
  material @4 :Material;
}

struct Mesh {
  enum Type {
    bezier @0;
    gregory @1;
    rational @2;  # this and what follows is Tessera's own
    pn @3;
  }

  name @0 :Text;
  type @1 :Type;
  positions @2 :List(Float32);  # xyz of 16 (bezier, rational) or 20 (gregory) control points a patch; pn: of 10 points and 6 normals
  weights @3 :List(Float32);    # rational: one a control point, above 0; else left out
}

# Tessera's own: the control cage of a subdivision surface. Objects name cages as they name meshes.
struct Cage {
  enum Scheme {
    catmullClark @0;
    loop @1;
    bilinear @2;
    none @3;  # polygons with smooth normals
  }

  # What happens along edges of a single face (RenderMan's interpolateboundary).
  enum Boundary {
    none @0;
    edgeAndCorner @1;
    edgeOnly @2;
  }

  struct Crease {
    a @0 :UInt32;  # vertices, in either order
    b @1 :UInt32;
    sharpness @2 :Float32;  # 0 and above; 10 and above: for ever
  }

  struct Corner {
    vertex @0 :UInt32;
    sharpness @1 :Float32;
  }

  name @0 :Text;
  scheme @1 :Scheme;
  boundary @2 :Boundary = edgeAndCorner;
  positions @3 :List(Float32);             # xyz a vertex
  faceSizes @4 :List(UInt32);              # corners of each face
  faceVertices @5 :List(UInt32);           # face after face, counter-clockwise seen from outside
  creases @6 :List(Crease);
  corners @7 :List(Corner);
  holes @8 :List(UInt32);                  # faces that shape the surface but are not drawn
  texturePositions @9 :List(Float32);      # uv a texture point
  faceTexturePoints @10 :List(UInt32);     # as many as faceVertices; left out where there are no texture points
}

struct Scene {
  meshes @0 :List(Mesh);
  lights @1 :List(LightSource);
  objects @2 :List(Object);
  cameras @3 :List(Camera);
  cages @4 :List(Cage);
}
