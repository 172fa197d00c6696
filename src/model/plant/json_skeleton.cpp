#include "model/plant/json_skeleton.h"

#include <QHash>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSet>
#include <algorithm>
#include <cmath>

#include "model/plant/frames.h"

namespace windfall::model {

namespace {

struct Node {
  qint64 id = 0, branch = -1;
  vec3 position{0};
  float radius = 0;
  std::vector<qint64> children;
};

/// Nesting of no skeleton; the parser recurses.
constexpr int kDeepest = 16;

bool tooDeep(const QByteArray& json) {
  int depth = 0;
  bool text = false;
  for (qsizetype i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (text) {
      i += c == '\\';
      text = c != '"';
    } else if (c == '"') {
      text = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

Result<Node> readNode(const QJsonObject& object, qsizetype index, QSet<QString>& unknown) {
  Node node;
  node.id = index;
  QString where = QStringLiteral("node %1: ").arg(index);
  const auto wrong = [&](const char* what) { return Error{(where + QLatin1String(what)).toStdString()}; };
  bool placed = false;
  for (auto field = object.begin(); field != object.end(); ++field) {
    const QString key = field.key().toLower();
    const QJsonValue value = field.value();
    if (key == QLatin1String("id")) {
      if (!value.isDouble() || std::abs(value.toDouble()) > 1e15) return wrong("id is no number");
      node.id = value.toInteger();
      where = QStringLiteral("node %1: ").arg(node.id);
    } else if (key == QLatin1String("position")) {
      const QJsonArray xyz = value.toArray();
      if (xyz.size() != 3) return wrong("position is not three numbers");
      for (int k = 0; k < 3; ++k) {
        if (!xyz[k].isDouble()) return wrong("position is not three numbers");
        node.position[k] = static_cast<float>(xyz[k].toDouble());
      }
      placed = true;
    } else if (key == QLatin1String("radius")) {
      if (!value.isDouble()) return wrong("radius is no number");
      node.radius = static_cast<float>(value.toDouble());
    } else if (key == QLatin1String("children")) {
      if (!value.isArray()) return wrong("children is no list");
      for (const QJsonValue child : value.toArray()) {
        if (!child.isDouble()) return wrong("a child is no number");
        node.children.push_back(child.toInteger());
      }
    } else if (key == QLatin1String("branch")) {
      if (!value.isDouble() || std::abs(value.toDouble()) > 2e9) return wrong("branch is no number");
      node.branch = value.toInteger();
    } else if (key != QLatin1String("rotation")) {
      unknown.insert(field.key().left(40));
    }
  }
  if (!placed) return wrong("has no position");
  return node;
}

/// Segments from nodes whose parents are known; nodes that are their own ancestors reach no root.
Result<SkeletonGraph> connect(const std::vector<Node>& nodes, const std::vector<std::int32_t>& parent,
                              const std::vector<std::vector<std::int32_t>>& children) {
  SkeletonGraph graph;
  graph.plants = 0;
  std::vector<std::int32_t> segmentTo(nodes.size(), -1), stack;
  std::size_t reached = 0;
  for (std::size_t root = 0; root < nodes.size(); ++root) {
    if (parent[root] >= 0) continue;
    stack.push_back(static_cast<std::int32_t>(root));
    while (!stack.empty()) {
      const auto n = static_cast<std::size_t>(stack.back());
      stack.pop_back();
      ++reached;
      for (auto child = children[n].rbegin(); child != children[n].rend(); ++child) stack.push_back(*child);
      if (parent[n] < 0) continue;
      const auto from = static_cast<std::size_t>(parent[n]);
      const Node &a = nodes[from], &b = nodes[n];
      Segment s;
      s.a = a.position, s.b = b.position;
      // Where several go on, only the node's own branch is as thick as the node.
      const bool goesOn = children[from].size() == 1 || (a.branch >= 0 && a.branch == b.branch);
      s.ra = goesOn ? a.radius : std::min(a.radius, b.radius);
      s.rb = b.radius;
      s.parent = segmentTo[from];
      s.branch = static_cast<std::int32_t>(b.branch);
      s.organ = static_cast<std::int32_t>(n);
      s.plant = graph.plants;
      segmentTo[n] = static_cast<std::int32_t>(graph.segments.size());
      graph.segments.push_back(s);
    }
    ++graph.plants;
  }
  if (reached < nodes.size()) return Error{"nodes go round in a circle"};
  if (graph.segments.empty()) return Error{"holds no plants"};
  return graph;
}

/// A node to write.
struct Out {
  vec3 position{0};
  float radius = 0;
  quat rotation{1, 0, 0, 0};
  std::int32_t branch = 0;
  std::vector<std::int32_t> children;
};

/// Y, X, Z order: R = Ry Rx Rz.
QJsonArray eulerDegrees(const quat& rotation) {
  const mat3 m = glm::mat3_cast(rotation);
  const auto degrees = [](float radians) { return static_cast<double>(radians) * 57.29577951308232; };
  return {degrees(std::asin(std::clamp(-m[2][1], -1.0f, 1.0f))), degrees(std::atan2(m[2][0], m[2][2])),
          degrees(std::atan2(m[0][1], m[1][1]))};
}

}  // namespace

Result<JsonSkeleton> readJsonSkeleton(const QByteArray& bytes) {
  if (tooDeep(bytes)) return Error{"is nested deeper than a skeleton"};
  QJsonParseError problem;
  const QJsonDocument document = QJsonDocument::fromJson(bytes, &problem);
  if (document.isNull()) {
    const qsizetype line = bytes.left(problem.offset).count('\n') + 1;
    return Error{"line " + std::to_string(line) + ": " + problem.errorString().toStdString()};
  }
  QJsonValue list;
  const QJsonObject root = document.object();
  for (auto field = root.begin(); field != root.end(); ++field) {
    if (field.key().toLower() == QLatin1String("nodes")) list = field.value();
  }
  if (!list.isArray()) return Error{"has no list of nodes"};
  std::vector<Node> nodes;
  QHash<qint64, std::int32_t> place;
  QSet<QString> unknown;
  for (const QJsonValue value : list.toArray()) {
    if (!value.isObject()) return Error{"node " + std::to_string(nodes.size()) + ": is no object"};
    Result<Node> node = readNode(value.toObject(), static_cast<qsizetype>(nodes.size()), unknown);
    if (!node) return node.error();
    if (place.contains(node->id)) return Error{"two nodes have the id " + std::to_string(node->id)};
    place.insert(node->id, static_cast<std::int32_t>(nodes.size()));
    nodes.push_back(std::move(*node));
  }
  std::vector<std::int32_t> parent(nodes.size(), -1);
  std::vector<std::vector<std::int32_t>> children(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::string where = "node " + std::to_string(nodes[i].id) + ": ";
    for (const qint64 id : nodes[i].children) {
      const auto child = place.constFind(id);
      if (child == place.constEnd()) return Error{where + "its child " + std::to_string(id) + " is not there"};
      std::int32_t& own = parent[static_cast<std::size_t>(*child)];
      if (own >= 0) return Error{where + "its child " + std::to_string(id) + " has another parent"};
      if (*child == static_cast<std::int32_t>(i)) return Error{where + "is its own child"};
      own = static_cast<std::int32_t>(i);
      children[i].push_back(*child);
    }
  }
  if (nodes.empty()) return Error{"holds no plants"};
  Result<SkeletonGraph> graph = connect(nodes, parent, children);
  if (!graph) return graph.error();
  graph = sortedGraph(std::move(*graph));
  if (!graph) return graph.error();
  JsonSkeleton skeleton;
  skeleton.graph = std::move(*graph);
  finishGraph(skeleton.graph);
  QStringList fields(unknown.begin(), unknown.end());
  fields.sort();
  if (!fields.isEmpty()) skeleton.warnings << QStringLiteral("unknown fields: %1").arg(fields.mid(0, 8).join(", "));
  return skeleton;
}

QByteArray writeJsonSkeleton(const SkeletonGraph& graph, const std::vector<std::int32_t>& chainOfSegment) {
  std::vector<Out> nodes;
  std::vector<std::int32_t> end(graph.segments.size(), -1), start(graph.segments.size(), -1);
  // Places on a segment where something leaves it, and the nodes there, by share.
  std::vector<std::vector<std::pair<float, std::int32_t>>> stops(graph.segments.size());
  for (std::size_t i = 0; i < graph.segments.size(); ++i) {
    const Segment& s = graph.segments[i];
    if (s.parent >= 0 && s.attach < 1) stops[static_cast<std::size_t>(s.parent)].emplace_back(s.attach, -1);
  }
  const auto add = [&](vec3 position, float radius, const Segment& s, std::size_t segment, std::int32_t parent) {
    Out node;
    node.position = position, node.radius = radius;
    node.rotation = alongZ(s.b - s.a);
    node.branch = chainOfSegment[segment];
    const auto index = static_cast<std::int32_t>(nodes.size());
    nodes.push_back(node);
    if (parent >= 0) nodes[static_cast<std::size_t>(parent)].children.push_back(index);
    return index;
  };
  for (std::size_t i = 0; i < graph.segments.size(); ++i) {
    const Segment& s = graph.segments[i];
    if (s.kind == SegmentKind::Root) continue;
    std::int32_t below = -1;
    if (s.parent < 0) {
      below = add(s.a, s.ra, s, i, -1);
    } else {
      const auto parent = static_cast<std::size_t>(s.parent);
      below = end[parent];
      for (const auto& [share, node] : stops[parent]) {
        if (share == s.attach) below = node;
      }
      if (s.attach <= 0 && start[parent] >= 0) below = start[parent];
      const vec3 from = nodes[static_cast<std::size_t>(below)].position;
      if (glm::length(s.a - from) > std::max(1e-4f, 0.5f * s.ra)) below = add(s.a, s.ra, s, i, below);
    }
    start[i] = below;
    auto& own = stops[i];
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    for (auto& [share, node] : own) {
      if (share > 0) below = add(s.a + (s.b - s.a) * share, s.ra + (s.rb - s.ra) * share, s, i, below);
      node = below;
    }
    end[i] = add(s.b, s.rb, s, i, below);
  }
  QJsonArray list;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto number = [](float value) { return QJsonValue(static_cast<double>(value)); };
    const Out& node = nodes[i];
    QJsonArray children;
    for (const std::int32_t child : node.children) children.append(child);
    list.append(
        QJsonObject{{"id", static_cast<qint64>(i)},
                    {"position", QJsonArray{number(node.position.x), number(node.position.y), number(node.position.z)}},
                    {"radius", number(node.radius)},
                    {"rotation", eulerDegrees(node.rotation)},
                    {"children", children},
                    {"branch", node.branch}});
  }
  return QJsonDocument(QJsonObject{{"nodes", list}}).toJson(QJsonDocument::Compact);
}

}  // namespace windfall::model
