/// FBX files with pictures, in FBX's text form, each beside its twin in Wavefront's.
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/meshes/mesh_file.h"
#include "tests/renderer/folder.h"

namespace stereobench::renderer {
namespace {

using test::Folder;

/// Three corners of a square and a fourth that is off, with a picture that they show a part of.
constexpr const char* kObj =
    "mtllib twin.mtl\nv 0 1 0\nv 0 -1 0\nv 0.5 -1 2\nv 0 1 3\nvt 0.25 0\nvt 1 0\nvt 1 0.75\nvt 0 1\n"
    "usemtl shown\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

/// The same as FBX in text; braces are fmt's.
constexpr char kFile[] = R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {{
  FBXHeaderVersion: 1003
  FBXVersion: 7400
}}
Objects:  {{
  Geometry: 1, "Geometry::twin", "Mesh" {{
    Vertices: *12 {{
      a: 0,1,0,0,-1,0,0.5,-1,2,0,1,3
    }}
    PolygonVertexIndex: *6 {{
      a: 0,1,-3,0,2,-4
    }}
    GeometryVersion: 124
    LayerElementUV: 0 {{
      Version: 101
      Name: "places"
      MappingInformationType: "ByPolygonVertex"
      ReferenceInformationType: "IndexToDirect"
      UV: *8 {{
        a: 0.25,0,1,0,1,0.75,0,1
      }}
      UVIndex: *6 {{
        a: 0,1,2,0,2,3
      }}
    }}
    LayerElementMaterial: 0 {{
      Version: 101
      Name: ""
      MappingInformationType: "AllSame"
      ReferenceInformationType: "IndexToDirect"
      Materials: *1 {{
        a: 0
      }}
    }}
    Layer: 0 {{
      Version: 100
      LayerElement:  {{
        Type: "LayerElementMaterial"
        TypedIndex: 0
      }}
      LayerElement:  {{
        Type: "LayerElementUV"
        TypedIndex: 0
      }}
    }}
  }}
  Model: 2, "Model::twin", "Mesh" {{
    Version: 232
    Shading: T
    Culling: "CullingOff"
  }}
  Material: 3, "Material::shown", "" {{
    Version: 102
    ShadingModel: "lambert"
    MultiLayer: 0
    Properties70:  {{
      P: "DiffuseColor", "Color", "", "A",1,0.5,1
    }}
  }}
{}}}
Connections:  {{
  C: "OO",2,0
  C: "OO",1,2
  C: "OO",3,2
{}}}
)";

/// @param objects, connections further ones: what the material shows
std::string fbx(const std::string& objects, const std::string& connections) {
  return fmt::format(kFile, objects, connections);
}

std::string texture(const std::string& file) {
  return fmt::format(
      "  Texture: 4, \"Texture::p\", \"\" {{\n    Type: \"TextureVideoClip\"\n    Version: 202\n"
      "    TextureName: \"Texture::p\"\n    FileName: \"{0}\"\n    RelativeFilename: \"{0}\"\n  }}\n",
      file);
}

/// Bytes as text (RFC 4648).
std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = i; k < i + 3; ++k) three = three << 8U | (k < bytes.size() ? bytes[k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kLetters[three >> (18 - 6 * k) & 63U];
  }
  return text;
}

cv::Mat picture() {
  cv::Mat bgr(16, 32, CV_8UC3, cv::Scalar(10, 20, 30));
  bgr(cv::Rect(0, 0, 7, 5)).setTo(cv::Scalar(200, 100, 50));
  return bgr;
}

void expect_twins(const Mesh& one, const Mesh& other) {
  ASSERT_EQ(one.textures.size(), 1U);
  ASSERT_EQ(other.textures.size(), 1U);
  EXPECT_EQ(one.textures[0].width_px, 32);
  EXPECT_EQ(one.textures[0].rgb, other.textures[0].rgb);
  ASSERT_EQ(one.triangles.size(), other.triangles.size());
  for (std::size_t i = 0; i < one.triangles.size(); ++i) {
    const Triangle &a = one.triangles[i], &b = other.triangles[i];
    EXPECT_EQ(a.texture, 0);
    EXPECT_TRUE(a.colour_rgb.isApprox(b.colour_rgb, 1e-6)) << a.colour_rgb.transpose();
    for (int corner = 0; corner < 3; ++corner) {
      EXPECT_TRUE(a.corners[corner].isApprox(b.corners[corner], 1e-6)) << i << ' ' << corner;
      EXPECT_TRUE(a.place_px[corner].isApprox(b.place_px[corner], 1e-5F)) << i << ' ' << corner;
    }
  }
}

// Mutation: pictures looked for in the working folder.
TEST(Fbx, ShowsThePictureBesideIt) {
  const Folder folder;
  folder.write("p.png", picture());
  folder.write("twin.mtl", "newmtl shown\nKd 1 0.5 1\nmap_Kd p.png\n");
  const std::string obj = folder.write("twin.obj", kObj);
  const std::string file =
      folder.write("twin.fbx", fbx(texture("p.png"), "  C: \"OP\",4,3, \"DiffuseColor\"\n"));
  expect_twins(read_textured_mesh(file), read_textured_mesh(obj));
}

// The picture within the file. Mutation: all pictures looked for in the folder.
TEST(Fbx, ShowsThePictureWithinIt) {
  const Folder folder;
  const std::string file = folder.write(
      "twin.fbx", fbx(texture("inside.png") +
                          fmt::format("  Video: 5, \"Video::p\", \"Clip\" {{\n    Type: \"Clip\"\n"
                                      "    FileName: \"inside.png\"\n    RelativeFilename: \"inside.png\"\n"
                                      "    Content: \"{}\"\n  }}\n",
                                      base64(encode_png(picture()))),
                      "  C: \"OP\",4,3, \"DiffuseColor\"\n  C: \"OO\",5,4\n"));
  folder.write("p.png", picture());
  folder.write("twin.mtl", "newmtl shown\nKd 1 0.5 1\nmap_Kd p.png\n");
  expect_twins(read_textured_mesh(file), read_textured_mesh(folder.write("twin.obj", kObj)));
}

}  // namespace
}  // namespace stereobench::renderer
