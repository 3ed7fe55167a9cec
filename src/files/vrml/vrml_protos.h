#pragma once

namespace icome::files {

/// PROTOs for things without nodes in VRML 2.0: docs/file-formats.md describes each field. Every geometry
/// PROTO shows an IndexedFaceSet, so that any viewer draws its triangles; ICOME reads the other fields.
/// Written at the head of a file that uses them, each only if it is used.
struct VrmlProto {
  const char* name;
  const char* fields;  // lines of VRML
  const char* body =
      nullptr;  // likewise; null: a geometry, which has the fields and the body of kTriangles too
};

/// Prefix of DEF names that stand for none, for nameless things that the file has to refer to.
inline constexpr const char* kNoName = "IcomeUnnamed";

/// DEF name of the Appearance of objects without a material: it looks like theirs, and is read as none.
inline constexpr const char* kNoMaterial = "IcomeDefault";

inline constexpr VrmlProto kTriangles = {"", R"(  field SFNode coord NULL
  field MFInt32 coordIndex []
  field SFFloat creaseAngle 0
  field SFBool solid TRUE
)",
                                         R"(  IndexedFaceSet {
    coord IS coord
    coordIndex IS coordIndex
    creaseAngle IS creaseAngle
    solid IS solid
  }
)"};

inline constexpr VrmlProto kMaterialProto = {"IcomeMaterial", R"(  field SFString name ""
  exposedField SFFloat ambientIntensity 0.2
  exposedField SFColor diffuseColor 0.8 0.8 0.8
  exposedField SFColor emissiveColor 0 0 0
  exposedField SFFloat shininess 0.2
  exposedField SFColor specularColor 0 0 0
  exposedField SFFloat transparency 0
  field SFFloat stiffness -1
  field SFFloat damping -1
  field SFFloat staticFriction 0
  field SFFloat dynamicFriction 0
  field SFString hapticTexture ""
)",
                                             R"(  Material {
    ambientIntensity IS ambientIntensity
    diffuseColor IS diffuseColor
    emissiveColor IS emissiveColor
    shininess IS shininess
    specularColor IS specularColor
    transparency IS transparency
  }
)"};

inline constexpr VrmlProto kCsgProto = {"IcomeCsg", R"(  field SFString tree ""
)"};

inline constexpr VrmlProto kLoopProto = {"IcomeLoopSurface", R"(  field MFVec3f controlPoint []
  field MFInt32 controlIndex []
  field MFInt32 crease []
  field MFInt32 corner []
)"};

inline constexpr VrmlProto kImplicitProto = {"IcomeImplicit", R"(  field SFString formula ""
  field SFString box ""
)"};

inline constexpr VrmlProto kDrawingProto = {"IcomeDrawing", R"(  field SFString svg ""
  field SFString body ""
)"};

/// Read, never written: a saved design holds the triangles of its meshes.
inline constexpr VrmlProto kMeshProto = {"IcomeMesh", R"(  field MFString url []
  field SFFloat unit 1
  field SFString package ""
)"};

inline constexpr VrmlProto kPrimitiveProto = {"IcomePrimitive", R"(  field SFString shape ""
  field SFString axis "z"
)"};

/// Other viewers show nothing for it.
inline constexpr VrmlProto kEffectProto = {"IcomeEffect", R"(  field SFString effect ""
  field SFBool on TRUE
)",
                                           R"(  Group {}
)"};

inline constexpr VrmlProto kSceneProto = {"IcomeScene", R"(  field SFString name ""
  field MFString objects []
)",
                                          R"(  Group {}
)"};

}  // namespace icome::files
