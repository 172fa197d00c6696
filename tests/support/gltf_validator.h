// Khronos's glTF validator, a tool of npm that ./dev test --all fetches.
#pragma once

#include <QFileInfo>
#include <QProcess>
#include <QStandardPaths>
#include <QString>

namespace windfall::test {

inline constexpr const char* kNoValidator =
    "gltf-validator is not there (npm install gltf-validator, WINDFALL_GLTF_VALIDATOR)";

inline bool hasValidator() {
  const QString modules = qEnvironmentVariable("WINDFALL_GLTF_VALIDATOR");
  return !QStandardPaths::findExecutable("node").isEmpty() && !modules.isEmpty() && QFileInfo::exists(modules);
}

/// The errors that it finds in a .glb or .gltf, "none" for nothing.
inline QString validatorErrors(const QString& file) {
  QProcess process;
  process.start("node",
                {"-e",
                 "const v=require(process.argv[1]),fs=require('fs'),path=require('path'),f=process.argv[2];"
                 "v.validateBytes(new Uint8Array(fs.readFileSync(f)),{uri:f,externalResourceFunction:u=>Promise."
                 "resolve(new Uint8Array(fs.readFileSync(path.join(path.dirname(f),decodeURIComponent(u)))))})"
                 ".then(r=>console.log(r.issues.numErrors?JSON.stringify(r.issues.messages.slice(0,4)):'none'))",
                 qEnvironmentVariable("WINDFALL_GLTF_VALIDATOR"), file});
  if (!process.waitForFinished(120'000)) return QStringLiteral("the validator does not end");
  return QString::fromUtf8(process.readAllStandardOutput()).trimmed();
}

}  // namespace windfall::test
