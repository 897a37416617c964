"""docs/first_run.md as it stands: each command is run, and prints what the page says."""

from manual import HOME, ManualTest, commands


class FirstRun(ManualTest):
    def test_every_command_prints_what_the_page_says(self):
        text = (HOME / "docs/first_run.md").read_text()
        self.put_files(text)
        told = 0
        for command, lines in commands(text):
            printed = [" ".join(line.split()) for line in self.execute(command).splitlines()]
            for line in lines:
                told += 1
                self.assertIn(" ".join(line.split()), printed, command)
        self.assertGreater(told, 20)
