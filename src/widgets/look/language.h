// The words of the program.
#pragma once

class QCoreApplication;

namespace windfall::widgets {

/// Texts with a number agree with it from now on: one leaf, two leaves. Once is enough; again does nothing.
void installPlurals(QCoreApplication& application);

}  // namespace windfall::widgets
