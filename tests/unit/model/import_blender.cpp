// A rig with two clips, two materials, a mesh below a mesh and vertices that no bone holds, written by Blender as FBX
// and as glTF: both are the same plant here.
#include <QFile>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cmath>

#include "model/plant/import.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

// A stem whose vertices between 1.4 and 1.8 m no bone holds, and below it another mesh. Four bones of 1 m, leaning;
// "sway" bends them by little, "storm" by more; keys on frames 1 to 49, 24 a second.
const char* const kScript = R"(
import bpy, bmesh, math, mathutils, sys
out = sys.argv[sys.argv.index('--') + 1]
bpy.ops.wm.read_factory_settings(use_empty=True)
data = bpy.data.armatures.new('rig')
rig = bpy.data.objects.new('rig', data)
bpy.context.collection.objects.link(rig)
bpy.context.view_layer.objects.active = rig
bpy.ops.object.mode_set(mode='EDIT')
last = None
for i in range(4):
    bone = data.edit_bones.new('b%d' % i)
    bone.head, bone.tail = (0.1 * i, 0, i), (0.1 * (i + 1), 0, i + 1)
    bone.parent, bone.use_connect = last, last is not None
    last = bone
bpy.ops.object.mode_set(mode='OBJECT')
mesh = bpy.data.meshes.new('stem')
form = bmesh.new()
bmesh.ops.create_cone(form, segments=12, radius1=0.2, radius2=0.05, depth=4)
tall = [e for e in form.edges if abs((e.verts[0].co - e.verts[1].co).z) > 1]
bmesh.ops.subdivide_edges(form, edges=tall, cuts=8)
for v in form.verts:
    v.co.z += 2
    v.co.x += 0.1 * v.co.z
form.to_mesh(mesh)
for name in ('Bark', 'Moss'):
    mesh.materials.append(bpy.data.materials.new(name))
for face in mesh.polygons:
    face.material_index = 0 if face.center.z > 1 else 1
stem = bpy.data.objects.new('stem', mesh)
bpy.context.collection.objects.link(stem)
stem.parent = rig
stem.modifiers.new('rig', 'ARMATURE').object = rig
for i in range(4):
    stem.vertex_groups.new(name='b%d' % i)
for v in mesh.vertices:
    if not 1.4 < v.co.z < 1.8:
        stem.vertex_groups[int(max(0, min(3.999, v.co.z)))].add([v.index], 1.0, 'REPLACE')
form = bmesh.new()
bmesh.ops.create_icosphere(form, subdivisions=1, radius=0.05, matrix=mathutils.Matrix.Translation((0.39, 0, 3.9)))
knot = bpy.data.objects.new('knot', bpy.data.meshes.new('knot'))
form.to_mesh(knot.data)
bpy.context.collection.objects.link(knot)
stone = bpy.data.objects.new('stone', knot.data.copy())
bpy.context.collection.objects.link(stone)
knot.parent = stem
knot.modifiers.new('rig', 'ARMATURE').object = rig
for i in range(4):
    knot.vertex_groups.new(name='b%d' % i)
knot.vertex_groups[3].add(range(len(knot.data.vertices)), 1.0, 'REPLACE')
rig.animation_data_create()
for name, size in (('sway', 0.05), ('storm', 0.2)):
    rig.animation_data.action = bpy.data.actions.new(name)
    rig.animation_data.action.use_fake_user = True
    for frame in range(0, 49, 6):
        for k, bone in enumerate(rig.pose.bones):
            half = 0.5 * size * math.sin(2 * math.pi * frame / 48) * (k + 1) / 4
            bone.rotation_mode = 'QUATERNION'
            bone.rotation_quaternion = (math.cos(half), math.sin(half), 0, 0)
            bone.keyframe_insert('rotation_quaternion', frame=frame + 1)
bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 49
bpy.ops.export_scene.fbx(filepath=out + '/rig.fbx', bake_anim=True, bake_anim_simplify_factor=0)
bpy.ops.export_scene.gltf(filepath=out + '/rig.glb', export_format='GLB')
bpy.context.scene.frame_set(13)
bpy.ops.export_scene.fbx(filepath=out + '/posed.fbx', bake_anim=False)
)";

PlantGeometry read(const QString& path) {
  Plant plant;
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  plant.file = {QFileInfo(path).fileName(), file.readAll()};
  Progress progress;
  Result<PlantGeometry> geometry = loadGeometry(plant, progress);
  if (!geometry) qWarning("%s", geometry.error().message.c_str());
  return geometry ? *geometry : PlantGeometry();
}

const Clip* clipNamed(const PlantGeometry& geometry, const QString& name) {
  for (const Clip& clip : geometry.clips) {
    if (clip.name.contains(name)) return &clip;
  }
  return nullptr;
}

/// Where the tip of the last bone is at a time of a clip.
vec3 tipAt(const PlantGeometry& geometry, const Clip& clip, double time) {
  return vec3(poseAt(clip, geometry.bones, time).back() * vec4(geometry.bones.back().tail, 1));
}

}  // namespace

class ImportBlenderTest : public QObject {
  Q_OBJECT
 private slots:
  void clipsAndMaterialsOfFbxAreThoseOfGltf() {
    const QString blender = QStandardPaths::findExecutable("blender");
    if (blender.isEmpty()) QSKIP("Blender is not there");
    QTemporaryDir folder;
    QFile script(folder.filePath("rig.py"));
    QVERIFY(script.open(QIODevice::WriteOnly));
    script.write(kScript);
    script.close();
    QProcess process;
    process.setProcessChannelMode(QProcess::MergedChannels);
    process.start(blender, {"-b", "--factory-startup", "-P", script.fileName(), "--", folder.path()});
    QVERIFY(process.waitForFinished(180'000));
    const QByteArray told = process.readAllStandardOutput();
    if (told.contains("No module named")) QSKIP("this Blender lacks Python modules that its glTF exporter needs");
    QVERIFY2(QFile::exists(folder.filePath("posed.fbx")), told.constData());

    const PlantGeometry fbx = read(folder.filePath("rig.fbx")), gltf = read(folder.filePath("rig.glb"));
    const PlantGeometry posed = read(folder.filePath("posed.fbx"));
    for (const PlantGeometry* one : {&fbx, &gltf, &posed}) {
      QCOMPARE(one->bones.size(), std::size_t{4});
      QStringList materials;
      for (const Material& material : one->materials) materials << material.name;
      QVERIFY2(materials.contains("Bark") && materials.contains("Moss"), qPrintable(materials.join(',')));
      QCOMPARE(one->parts.size(), std::size_t{4});
      QCOMPARE(one->clips.size(), one == &posed ? std::size_t{0} : std::size_t{2});
      // Everything stands where Blender has it, in metres, and moves with the bone at its height.
      QVERIFY2(one->notes.join(';').contains("held by no bone"), qPrintable(one->notes.join(';')));
      QVERIFY2(one->notes.join(';').contains("is bound to no bone"), qPrintable(one->notes.join(';')));
      for (const Vertex& vertex : one->vertices) {
        QVERIFY(std::abs(vertex.position.y - 2) < 2.1f && std::hypot(vertex.position.x, vertex.position.z) < 0.7f);
        const auto bone = static_cast<float>(vertex.bones[0]);
        if (vertex.position.y > 3.8f && bone == 0) continue;  // the stone
        QVERIFY2(vertex.position.y > bone - 0.45f && vertex.position.y < bone + 1.45f,
                 qPrintable(QString("%1 m: bone %2").arg(double(vertex.position.y)).arg(vertex.bones[0])));
      }
      QVERIFY(std::any_of(one->vertices.begin(), one->vertices.end(),
                          [](const Vertex& vertex) { return std::abs(vertex.position.y - 1.6f) < 0.2f; }));
    }
    for (const auto& [name, reach] : {std::pair("sway", 0.05f), std::pair("storm", 0.2f)}) {
      const Clip *a = clipNamed(fbx, name), *b = clipNamed(gltf, name);
      QVERIFY(a != nullptr && b != nullptr);
      QVERIFY(std::abs(a->length - 2) < 1e-3 && std::abs(b->length - 2) < 1e-3);
      QVERIFY(a->looping && b->looping);
      float farthest = 0;
      for (const double time : {0.0, 0.5, 1.0, 1.5, 2.0}) {
        const vec3 one = tipAt(fbx, *a, time), other = tipAt(gltf, *b, time);
        QVERIFY2(glm::length(one - other) < 0.01f, qPrintable(QString("%1 at %2 s").arg(name).arg(time)));
        farthest = std::max(farthest, glm::length(one - fbx.bones.back().tail));
      }
      // The joints turn by 1/4, 1/2, 3/4 and the whole of `reach`, at 4 m to 1 m from the tip.
      QVERIFY2(std::abs(farthest - reach * 5) < 0.1f * reach * 5, qPrintable(QString::number(double(farthest))));
    }
  }
};

WINDFALL_SUITE(ImportBlenderTest)
#include "import_blender.moc"
