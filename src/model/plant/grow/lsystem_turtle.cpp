#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "model/plant/grow/lsystem.h"

namespace windfall::model::growth {

namespace {

constexpr std::size_t kChunk = 4096;
constexpr double kRadians = std::numbers::pi / 180, kFarthest = 100;
constexpr std::size_t kWorthThreads = 1'000'000;  ///< modules below which the walk in order is faster (3.4)

/// A rigid motion, and what brackets keep. In a chunk's own walk `width` and `node` may be those of its base.
struct State {
  dvec3 position{0};
  dquat frame{1, 0, 0, 0};  ///< turns heading +Y, left -X, up +Z
  double width = 0;
  bool hasWidth = false;
  int node = 0;
  bool hasNode = false;
  bool lifted = false;  ///< an f moved it away from its node
  int colour = 0;
};

enum class Command : std::uint8_t { None, Link, Move, Turn, Pitch, Roll, Back, Level, Width, Leaf, Push, Pop, Colour };

struct Meaning {
  Command command = Command::None;
  double sign = 1;
};

std::vector<Meaning> meanings(const LSystem& system) {
  std::vector<Meaning> all;
  for (const std::string& name : system.names) {
    Meaning m;
    if (name == "F" || name == "G") m.command = Command::Link;
    if (name == "f") m.command = Command::Move;
    if (name == "+" || name == "-") m = {Command::Turn, name == "+" ? 1.0 : -1.0};
    if (name == "&" || name == "^") m = {Command::Pitch, name == "&" ? 1.0 : -1.0};
    if (name == "\\" || name == "/") m = {Command::Roll, name == "\\" ? 1.0 : -1.0};
    if (name == "|") m.command = Command::Back;
    if (name == "$") m.command = Command::Level;
    if (name == "!") m.command = Command::Width;
    if (name == "~") m.command = Command::Leaf;
    if (name == "[") m.command = Command::Push;
    if (name == "]") m.command = Command::Pop;
    if (name == "'") m.command = Command::Colour;
    all.push_back(m);
  }
  return all;
}

const dvec3 kHeading(0, 1, 0), kLeft(-1, 0, 0), kUp(0, 0, 1);

/// What a module asks for, where it takes a number.
double argument(const LSystem& system, const ModuleString& m, std::size_t i, Command command) {
  if (m.first[i + 1] > m.first[i]) return m.parameter[m.first[i]];
  switch (command) {
    case Command::Link:
    case Command::Move:
      return system.step;
    case Command::Width:
      return system.width;
    case Command::Leaf:
      return 0.05;
    default:
      return system.angle;
  }
}

/// Turns by a module; false: it is no turn that needs only itself.
bool turn(State& state, const Meaning& meaning, double x) {
  const auto about = [&](dvec3 axis, double degrees) {
    const double half = 0.5 * degrees * kRadians;
    const dquat by(std::cos(half), std::sin(half) * axis);
    state.frame = state.frame * by;
  };
  switch (meaning.command) {
    case Command::Turn:
      about(kUp, meaning.sign * x);
      return true;
    case Command::Pitch:
      about(kLeft, meaning.sign * x);
      return true;
    case Command::Roll:
      about(kHeading, meaning.sign * x);
      return true;
    case Command::Back:
      about(kUp, 180);
      return true;
    default:
      return false;
  }
}

/// $: rolls about the heading until left is level.
void level(State& state) {
  const dvec3 heading = glm::normalize(state.frame * kHeading);
  const dvec3 left = glm::cross(dvec3(0, 1, 0), heading);
  if (glm::length(left) < 1e-9) return;
  const dvec3 wanted = glm::normalize(left), now = state.frame * kLeft;
  const double angle = std::atan2(glm::dot(glm::cross(now, wanted), heading), glm::dot(now, wanted));
  const double half = 0.5 * angle;
  state.frame = dquat(std::cos(half), std::sin(half) * heading) * state.frame;
}

/// The heading gives way to weight: about H x T by bend |H x T| (T downwards).
void sag(State& state, double bend) {
  const dvec3 heading = state.frame * kHeading, axis = glm::cross(heading, dvec3(0, -1, 0));
  const double size = glm::length(axis);
  if (size < 1e-12) return;
  const double half = 0.5 * bend * size;
  state.frame = dquat(std::cos(half), std::sin(half) / size * axis) * state.frame;
}

Error lengthError(const std::string& name, double x) {
  return Error{"a module " + name + "(" + std::to_string(x) + ") is longer than 100 m"};
}

/// Makes a node at the state; empty when all is well.
std::optional<Error> checkLink(const LSystem& system, const LSystemLimits& limits, Symbol symbol, double x,
                               std::size_t links, bool lifted) {
  if (!(std::abs(x) <= kFarthest)) return lengthError(system.names[symbol], x);
  if (lifted) return Error{"a link behind f hangs on nothing: close a bracket first"};
  if (links > limits.links) return Error{"the rules make more than " + std::to_string(limits.links) + " links"};
  return {};
}

}  // namespace

Result<Grown> interpretInOrder(const LSystem& system, const ModuleString& modules, const LSystemLimits& limits) {
  const std::vector<Meaning> meaning = meanings(system);
  Grown grown;
  State state;
  state.node = grown.add(dvec3(0), -1, 0);
  std::vector<State> stack;
  for (std::size_t i = 0; i < modules.size(); ++i) {
    const Meaning& m = meaning[modules.symbol[i]];
    if (m.command == Command::None) continue;
    const double x = argument(system, modules, i, m.command);
    if (turn(state, m, x)) continue;
    switch (m.command) {
      case Command::Link: {
        if (const auto error = checkLink(system, limits, modules.symbol[i], x, grown.size(), state.lifted))
          return *error;
        state.position += x * (state.frame * kHeading);
        if (std::abs(x) > 1e-9) {
          state.node = grown.add(state.position, state.node, static_cast<int>(grown.size()));
          grown.radius.back() = 0.5 * state.width;
        }
        if (system.bend != 0) sag(state, system.bend);
        state.frame = glm::normalize(state.frame);
        break;
      }
      case Command::Move:
        if (!(std::abs(x) <= kFarthest)) return lengthError("f", x);
        state.position += x * (state.frame * kHeading);
        state.lifted = state.lifted || x != 0;
        break;
      case Command::Level:
        level(state);
        break;
      case Command::Width:
        state.width = x;
        break;
      case Command::Colour:
        ++state.colour;
        break;
      case Command::Leaf:
        grown.leaves.push_back(
            {state.node, state.position, state.frame * kHeading, state.frame * kUp, x, state.colour});
        break;
      case Command::Push:
        if (stack.size() >= static_cast<std::size_t>(limits.depth)) return Error{"brackets are nested too deeply"};
        stack.push_back(state);
        break;
      case Command::Pop:
        state = stack.back();
        stack.pop_back();
        break;
      default:
        break;
    }
  }
  return grown;
}

namespace {

/// What one chunk knows of itself: everything relative to the state at its start, or to the k-th bracket that was open
/// before it and that it closes.
struct Chunk {
  struct Made {
    State local;
    int base = 0;  ///< 0: the chunk's start, k: after k brackets were closed
    std::size_t module = 0;
  };
  std::vector<Made> links, leaves;
  std::vector<std::pair<State, int>> open;  ///< states that it leaves on the stack
  State end;
  int endBase = 0, closed = 0;
  int firstNode = 0;
  std::optional<Error> error;
};

State onto(const State& base, const State& local) {
  State world = local;
  world.position = base.position + base.frame * local.position;
  world.frame = glm::normalize(base.frame * local.frame);
  if (!local.hasWidth) world.width = base.width;
  if (!local.hasNode) world.node = base.node;
  world.lifted = local.hasNode ? local.lifted : local.lifted || base.lifted;
  world.colour = base.colour + local.colour;
  world.hasWidth = world.hasNode = true;
  return world;
}

void walk(const LSystem& system, const ModuleString& modules, const std::vector<Meaning>& meaning, std::size_t from,
          std::size_t to, const LSystemLimits& limits, Chunk& chunk) {
  State state;
  int base = 0;
  std::vector<std::pair<State, int>> stack;
  int node = chunk.firstNode;
  for (std::size_t i = from; i < to; ++i) {
    const Meaning& m = meaning[modules.symbol[i]];
    if (m.command == Command::None) continue;
    const double x = argument(system, modules, i, m.command);
    if (turn(state, m, x)) continue;
    switch (m.command) {
      case Command::Link:
        if (const auto error = checkLink(system, limits, modules.symbol[i], x, 0, false)) {
          chunk.error = *error;
          return;
        }
        state.position += x * (state.frame * kHeading);
        state.frame = glm::normalize(state.frame);
        if (std::abs(x) > 1e-9) {
          // The local state still names the node before it: that is the parent.
          chunk.links.push_back({state, base, i});
          state.node = node++, state.hasNode = true;
        }
        break;
      case Command::Move:
        if (!(std::abs(x) <= kFarthest)) {
          chunk.error = lengthError("f", x);
          return;
        }
        state.position += x * (state.frame * kHeading);
        state.lifted = state.lifted || x != 0;
        break;
      case Command::Width:
        state.width = x, state.hasWidth = true;
        break;
      case Command::Colour:
        ++state.colour;
        break;
      case Command::Leaf:
        chunk.leaves.push_back({state, base, i});
        break;
      case Command::Push:
        stack.emplace_back(state, base);
        break;
      case Command::Pop:
        if (stack.empty()) {
          base = ++chunk.closed;
          state = State();
        } else {
          std::tie(state, base) = stack.back();
          stack.pop_back();
        }
        break;
      default:
        break;
    }
  }
  chunk.open = std::move(stack);
  chunk.end = state, chunk.endBase = base;
}

}  // namespace

Result<Grown> interpretInParallel(const LSystem& system, const ModuleString& modules, const LSystemLimits& limits) {
  const std::vector<Meaning> meaning = meanings(system);
  const std::size_t n = modules.size(), count = (n + kChunk - 1) / kChunk;
  std::vector<Chunk> chunks(count);
  // Numbers of nodes first, so that every chunk can name its own.
  std::vector<int> links(count, 0);
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < count; ++c) {
    for (std::size_t i = c * kChunk; i < std::min(n, (c + 1) * kChunk); ++i) {
      const Meaning& m = meaning[modules.symbol[i]];
      if (m.command == Command::Link && std::abs(argument(system, modules, i, m.command)) > 1e-9) ++links[c];
    }
  }
  std::size_t all = 1;
  for (std::size_t c = 0; c < count; ++c) chunks[c].firstNode = static_cast<int>(all), all += at(links[c]);
  if (all > limits.links + 1) return Error{"the rules make more than " + std::to_string(limits.links) + " links"};
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t c = 0; c < count; ++c) {
    walk(system, modules, meaning, c * kChunk, std::min(n, (c + 1) * kChunk), limits, chunks[c]);
  }
  // Where every chunk starts, and what it finds on the stack: serial, tiny.
  std::vector<std::vector<State>> bases(count);
  State entry;
  entry.hasNode = entry.hasWidth = true;
  std::vector<State> stack;
  for (std::size_t c = 0; c < count; ++c) {
    Chunk& chunk = chunks[c];
    if (chunk.error) return *chunk.error;
    std::vector<State>& base = bases[c];
    base.push_back(entry);
    for (int k = 0; k < chunk.closed; ++k) {
      base.push_back(stack.back());
      stack.pop_back();
    }
    for (const auto& [state, of] : chunk.open) stack.push_back(onto(base[at(of)], state));
    if (stack.size() > static_cast<std::size_t>(limits.depth)) return Error{"brackets are nested too deeply"};
    entry = onto(base[at(chunk.endBase)], chunk.end);
  }
  Grown grown;
  grown.position.resize(all, dvec3(0));
  grown.parent.resize(all, -1);
  grown.radius.resize(all, 0);
  grown.birth.resize(all, 0);
  grown.continues.resize(all, 0);
  grown.source.resize(all, 0);
  std::vector<std::vector<GivenLeaf>> leaves(count);
  std::vector<char> lifted(count, 0);
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t c = 0; c < count; ++c) {
    int node = chunks[c].firstNode;
    for (const Chunk::Made& made : chunks[c].links) {
      const State world = onto(bases[c][at(made.base)], made.local);
      const auto i = at(node);
      grown.position[i] = world.position, grown.parent[i] = world.node, grown.radius[i] = 0.5 * world.width;
      grown.birth[i] = grown.source[i] = node++;
      if (world.lifted) lifted[c] = 1;
    }
    for (const Chunk::Made& made : chunks[c].leaves) {
      const State world = onto(bases[c][at(made.base)], made.local);
      leaves[c].push_back({world.node, world.position, world.frame * kHeading, world.frame * kUp,
                           argument(system, modules, made.module, Command::Leaf), world.colour});
    }
  }
  if (std::find(lifted.begin(), lifted.end(), 1) != lifted.end()) {
    return Error{"a link behind f hangs on nothing: close a bracket first"};
  }
  for (std::vector<GivenLeaf>& part : leaves) grown.leaves.insert(grown.leaves.end(), part.begin(), part.end());
  return grown;
}

Result<Grown> interpret(const LSystem& system, const ModuleString& modules, const LSystemLimits& limits,
                        Progress& progress) {
  if (progress.cancelled()) return Error{"cancelled", true};
  const bool looksAtWorld = system.bend != 0 || system.find("$") < system.names.size();
  return looksAtWorld || modules.size() < kWorthThreads ? interpretInOrder(system, modules, limits)
                                                        : interpretInParallel(system, modules, limits);
}

}  // namespace windfall::model::growth
