#include "model/document/project_file.h"

namespace windfall::model {

Result<Project> readProject(const QString&, Progress&) { return Error{"project files cannot be read yet"}; }
Status writeProject(const Project&, const QString&, Progress&) { return Error{"project files cannot be written yet"}; }

}  // namespace windfall::model
