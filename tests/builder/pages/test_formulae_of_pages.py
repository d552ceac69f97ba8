"""Which characters the formulae of a book use, told by what its pages show."""

from pathlib import Path

from scale.trees import BUILDERS, write_book

from site_builder.build import Options, check_site
from site_builder.kept.keeper import Keeper, keeping
from site_builder.pages.formulae import formula_characters


def test_no_formula_is_set_again_for_its_characters(tmp_path: Path) -> None:
    """Inline or displayed, it was set when its chapter was read."""
    write_book(BUILDERS[0], 1, tmp_path)
    keeper = Keeper()
    with keeping(keeper):
        book, _, _ = check_site(Options(tmp_path, runtime=False))
        keeper.made.clear()
        assert {"x", "′", "="} <= formula_characters(book)
    assert {name.rpartition(".")[2] for name in keeper.made} == {"characters"}
