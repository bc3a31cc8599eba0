"""What several kinds of forces are made of: friction of joints, the strain of a beam."""
