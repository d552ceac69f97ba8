"""The book's questions as learning platforms import them: Moodle XML, and a package of QTI 2.1.

How a question of a kind is written stands in the kind's folder, ``moodle.xml`` and ``qti.xml``.
"""
