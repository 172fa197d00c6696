// A disk that is soon full: a memory file system of a few kilobytes, where the test may mount one.
#pragma once

#include <sys/mount.h>

#include <QDir>
#include <QTemporaryDir>

namespace windfall::test {

class SmallDisk {
 public:
  explicit SmallDisk(int kilobytes) {
    const QByteArray size = "size=" + QByteArray::number(kilobytes) + "k";
    mounted_ =
        folder_.isValid() && mount("none", folder_.path().toLocal8Bit().constData(), "tmpfs", 0, size.constData()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount2(folder_.path().toLocal8Bit().constData(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  /// Else the test has no right to mount anything: skip it.
  bool isMounted() const { return mounted_; }
  QString filePath(const QString& name) const { return folder_.filePath(name); }
  /// What lies on it, hidden files too.
  QString names() const {
    return QDir(folder_.path())
        .entryList(QDir::AllEntries | QDir::Hidden | QDir::System | QDir::NoDotAndDotDot)
        .join(' ');
  }
  bool isEmpty() const { return names().isEmpty(); }

 private:
  QTemporaryDir folder_;
  bool mounted_ = false;
};

}  // namespace windfall::test
