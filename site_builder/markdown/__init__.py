"""Markdown to the document. Start at ``chapter.py``; ``parser.py`` lists the rules, and
``directives/`` and ``roles/`` what authors may write beyond Markdown."""
