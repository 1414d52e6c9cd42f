"""The list that breccia keeps of the files that it wrote into a folder of results: see io/files/folder_lock.hpp."""
from .errors import FileTrouble

LIST = ".breccia-files"


def claim(path):
    """Puts a file that will be written on the list of its folder, where there is one.

    FileTrouble where somebody else put a file of that name there.
    """
    listed = path.parent / LIST
    if not listed.is_file():
        return
    try:
        if path.name in listed.read_text(encoding="utf-8").splitlines():
            return
        if path.is_symlink() or path.exists():
            raise FileTrouble(f"{path} is there, and breccia did not draw it; move it away, or choose another folder with --out")
        with listed.open("a", encoding="utf-8") as file:
            file.write(path.name + "\n")
    except OSError as reason:
        raise FileTrouble(f"{listed} cannot be written: {reason.strerror or reason}") from reason
