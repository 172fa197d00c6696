// What every undo step of a document shares.
#pragma once

#include <QUndoCommand>

#include "model/ids.h"

namespace windfall::model {

class Document;
struct Change;
struct Project;

/// The only way into a document's project: an undo step that names its objects by id and says what it changed.
class DocumentCommand : public QUndoCommand {
 public:
  DocumentCommand(Document& document, const QString& text);

 protected:
  const Project& project() const;
  Project& project();
  /// Emits Document::changed; call it when the project is whole again.
  void announce(const Change& change);

 private:
  Document& document_;
};

}  // namespace windfall::model
