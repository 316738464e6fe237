"""Builds conda/recipe.yaml from a wheel into its folder, and compares the package with the wheel.

    conda.py VERSION WHEEL

Only the recipe's tests are not run: they need Python and NumPy of a conda channel.
"""

import os
import shutil
import sys
import tempfile
import zipfile
from pathlib import Path

from rattler_build import Package, Stage0Recipe, ToolConfiguration

version, wheel = sys.argv[1], Path(sys.argv[2]).resolve()
recipe = Path(__file__).resolve().parent.parent / "conda" / "recipe.yaml"
with tempfile.TemporaryDirectory() as folder:
    # The build unpacks a file with this ending.
    packed = shutil.copy(wheel, Path(folder, "wheel.zip"))
    os.environ |= {"PUSHPLAN_VERSION": version, "PUSHPLAN_WHEEL": str(packed)}
    [built] = Stage0Recipe.from_file(recipe).run_build(
        output_dir=Path(folder, "out"),
        channels=[],
        package_format="conda",
        # A rendered recipe contains names of folders on this machine.
        no_include_recipe=True,
        tool_config=ToolConfiguration(test_strategy="skip"),
    )
    package = Package.from_file(built.packages[0])
    inside = {path for path in package.files if not path.startswith("info/")}
    wanted = {f"site-packages/{name}" for name in zipfile.ZipFile(wheel).namelist()}
    if inside != wanted:
        sys.exit(f"package and wheel differ in {sorted(inside ^ wanted)}")
    shutil.copyfile(package.path, wheel.parent / package.filename)
    print(f"{package.filename} for {package.subdir}", *package.depends, sep="\n  ")
